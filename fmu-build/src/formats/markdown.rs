//! Tables for pages that are written in Markdown, as the README is.

/// A table with a heading for each column.
#[must_use]
pub fn table<T: AsRef<str>>(head: &[T], rows: &[Vec<String>]) -> String {
    let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
    let head_line = line(head.iter().map(|cell| escaped(cell.as_ref())).collect());
    let rule = line(vec!["---".to_owned(); head.len()]);
    let rows = rows.iter().map(|row| line(row.iter().map(|cell| escaped(cell)).collect()));
    [head_line, rule].into_iter().chain(rows).collect()
}

/// A bar would begin another cell.
fn escaped(cell: &str) -> String {
    cell.replace('|', "\\|")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_stand_between_bars() {
        let text = table(&["a", "b|c"], &[vec!["1".to_owned(), String::new()]]);
        assert_eq!(text, "| a | b\\|c |\n| --- | --- |\n| 1 |  |\n");
    }
}
