//! Mistakes in TOML, in the words of those who write scenarios.

use toml::de::DeTable;

use super::Problem;
use super::reader::Entry;

/// What TOML's `message` on the `place` in a `line` with this number means to those who write scenarios. `entries` is
/// what could be read all the same.
pub(super) fn problem(message: &str, place: &str, line: &str, number: usize, entries: &[Entry<'_>]) -> Problem {
    let corrected = with_quotes(line);
    if corrected != line && DeTable::parse(&corrected).is_ok() {
        return Problem::Unquoted { corrected: corrected.trim().to_owned() };
    }
    // As far as it stands in this line; tables above it come first in the whole name.
    let key: String = line.split('=').next().unwrap_or_default().chars().filter(|c| !" \t\"'".contains(*c)).collect();
    let same =
        |entry: &&Entry<'_>| entry.line < number && (entry.key == key || entry.key.ends_with(&format!(".{key}")));
    match entries.iter().rfind(same) {
        Some(first) if key.ends_with(place) && message.contains("duplicate") => {
            Problem::Repeated { key: first.key.clone(), first: first.line }
        }
        _ => Problem::Syntax { message: message.to_owned(), text: printable(line.trim()) },
    }
}

/// A line with quotes about every name with brackets.
fn with_quotes(line: &str) -> String {
    let is_part = |c: char| c.is_ascii_alphanumeric() || "_-.".contains(c);
    let (mut quoted, mut rest) = (String::new(), line);
    while let Some(c) = rest.chars().next() {
        let mut length = rest.find(|c| !is_part(c)).unwrap_or(rest.len());
        let plain = length;
        while length > 0
            && let Some(index) = index_length(&rest[length..])
        {
            length += index;
            length += rest[length..].find(|c| !is_part(c)).unwrap_or(rest.len() - length);
        }
        let quote = if length > plain { "\"" } else { "" };
        // What stands in quotes already, and comments, stay as they are.
        if length == 0 {
            length = match c {
                '"' | '\'' => rest[1..].find(c).map_or(rest.len(), |end| end + 2),
                '#' => rest.len(),
                c => c.len_utf8(),
            };
        }
        quoted = quoted + quote + &rest[..length] + quote;
        rest = &rest[length..];
    }
    quoted
}

/// Length of an index like `[12]` at the beginning of a text.
fn index_length(text: &str) -> Option<usize> {
    let (index, _) = text.strip_prefix('[')?.split_once(']')?;
    (!index.is_empty() && index.bytes().all(|byte| byte.is_ascii_digit())).then_some(index.len() + 2)
}

/// A text that does a terminal no harm.
pub(super) fn printable(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_with_brackets_gets_quotes_and_nothing_else() {
        for (line, expected) in [
            ("link[1].mass = 2", "\"link[1].mass\" = 2"),
            ("  reference.leg[12].dx=0.1 # leg[12]", "  \"reference.leg[12].dx\"=0.1 # leg[12]"),
            ("parameters.link[1].mass = 2", "\"parameters.link[1].mass\" = 2"),
            ("[parameters.link[1]]", "[\"parameters.link[1]\"]"),
            ("p = { link[1].mass = 2, link[2].mass = 3 }", "p = { \"link[1].mass\" = 2, \"link[2].mass\" = 3 }"),
            ("\"link[1].mass\" = 2", "\"link[1].mass\" = 2"),
            ("title = 'of link[1]", "title = 'of link[1]"),
            ("a = [1]", "a = [1]"),
            ("Größe[1] = 1 é", "Größ\"e[1]\" = 1 é"),
            ("a[] = b[x]", "a[] = b[x]"),
            ("", ""),
        ] {
            assert_eq!(with_quotes(line), expected);
        }
    }
}
