//! Numbered pieces of work, shared out among threads and watched.

use std::ops::Range;
use std::thread;

use crate::watch;

/// Does `work` with every number, in so many threads; `begin` makes what a thread needs for all of its pieces, `sum`
/// puts two results together, in any order.
///
/// # Errors
/// Of the first thread that meets one.
pub fn share<S, R: Send + Default>(
    numbers: Range<u64>,
    threads: u16,
    begin: impl Fn() -> Result<S, String> + Sync,
    work: impl Fn(&mut S, u64) -> Result<R, String> + Sync,
    sum: impl Fn(R, R) -> R + Copy + Send + Sync,
) -> Result<R, String> {
    let threads = usize::from(threads);
    let (begin, work) = (&begin, &work);
    thread::scope(|scope| {
        let helpers: Vec<_> = (0..threads)
            .map(|thread| {
                let mine = numbers.clone().skip(thread).step_by(threads);
                scope.spawn(move || {
                    let mut tools = begin()?;
                    let mut total = R::default();
                    for number in mine {
                        watch::playing(thread, Some(number));
                        total = sum(total, work(&mut tools, number)?);
                    }
                    watch::playing(thread, None);
                    Ok(total)
                })
            })
            .collect();
        let results = helpers.into_iter().map(|helper| helper.join().expect("they do not panic"));
        results.reduce(|one, other| Ok(sum(one?, other?))).unwrap_or_else(|| Ok(R::default()))
    })
}
