//! Everything is measured in turns, round after round, so that whatever else the machine does hits all alike.

/// What is measured.
pub struct Candidate<'a> {
    pub name: String,
    /// The largest error of what it computes, if there is one.
    pub error: Option<f64>,
    /// Works for some milliseconds, and says how long each piece of work took \[s\].
    pub work: Box<dyn FnMut() -> f64 + 'a>,
}

impl<'a> Candidate<'a> {
    pub fn new(name: impl Into<String>, error: Option<f64>, work: impl FnMut() -> f64 + 'a) -> Self {
        Self { name: name.into(), error, work: Box::new(work) }
    }
}

/// Candidates that do the same; the first one is ours.
pub struct Contest<'a> {
    pub title: &'static str,
    pub candidates: Vec<Candidate<'a>>,
}

/// Median and extremes.
#[derive(Debug, Clone, Copy)]
pub struct Spread {
    pub median: f64,
    pub least: f64,
    pub most: f64,
}

impl Spread {
    pub fn of(mut values: Vec<f64>) -> Self {
        values.sort_by(f64::total_cmp);
        let (least, most) = (values[0], values[values.len() - 1]);
        Self { median: values[values.len() / 2], least, most }
    }

    /// Of the reciprocal values.
    pub fn inverse(self) -> Self {
        Self { median: 1.0 / self.median, least: 1.0 / self.most, most: 1.0 / self.least }
    }
}

/// What came out for one candidate.
pub struct Measured {
    pub name: String,
    pub error: Option<f64>,
    /// Time of a piece of work \[s\].
    pub time: Spread,
    /// This time as a multiple of that of the first candidate in the same round.
    pub ratio: Spread,
}

/// The fastest of so many repetitions, which nothing else has held up.
pub fn fastest(times: u32, mut run: impl FnMut() -> f64) -> f64 {
    (0..times).map(|_| run()).fold(f64::INFINITY, f64::min)
}

/// Lets all candidates work once per round.
pub fn measure(contest: &mut Contest<'_>, rounds: usize) -> Vec<Measured> {
    let candidates = &mut contest.candidates;
    // Caches and clocks of the processor.
    candidates.iter_mut().for_each(|candidate| {
        (candidate.work)();
    });
    let rows: Vec<Vec<f64>> =
        (0..rounds).map(|_| candidates.iter_mut().map(|candidate| (candidate.work)()).collect()).collect();
    candidates
        .iter()
        .enumerate()
        .map(|(i, candidate)| Measured {
            name: candidate.name.clone(),
            error: candidate.error,
            time: Spread::of(rows.iter().map(|row| row[i]).collect()),
            ratio: Spread::of(rows.iter().map(|row| row[i] / row[0]).collect()),
        })
        .collect()
}
