//! Parallel work on a list, with the results in its order.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{self, Sender};
use std::thread;

/// Works on a list in parallel, and passes the results to `hand_on` in order of the items, each as soon as it and those
/// before it are complete. After an error of `hand_on`, no more work is started. There are at most `most` threads; if
/// no other can be started, the caller's thread does the work. These are not rayon's threads, which run the parts of a
/// simulation: a rayon thread that waits for a part would start another item, and return only when that is done.
pub(super) fn in_order<T: Sync, R: Send, E>(
    most: usize,
    items: &[T],
    work: impl Fn(usize, &T) -> R + Sync,
    mut hand_on: impl FnMut(R) -> Result<(), E>,
) -> Result<(), E> {
    let threads = most.min(items.len());
    if threads <= 1 {
        return one_by_one(items, work, hand_on);
    }
    let next = AtomicUsize::new(0);
    let take = |results: Sender<(usize, R)>| {
        while let Some((place, item)) = pick(items, &next) {
            if results.send((place, work(place, item))).is_err() {
                break;
            }
        }
    };
    thread::scope(|scope| {
        let (sender, results) = mpsc::channel();
        let start = |_: &usize| {
            let (take, sender) = (&take, sender.clone());
            thread::Builder::new().spawn_scoped(scope, move || take(sender)).is_ok()
        };
        if (0..threads).take_while(start).count() == 0 {
            return one_by_one(items, &work, hand_on);
        }
        drop(sender);
        let (mut early, mut due) = (BTreeMap::new(), 0);
        for (place, result) in results {
            early.insert(place, result);
            while let Some(result) = early.remove(&due) {
                hand_on(result)?;
                due += 1;
            }
        }
        Ok(())
    })
}

fn one_by_one<T, R, E>(
    items: &[T],
    work: impl Fn(usize, &T) -> R,
    mut hand_on: impl FnMut(R) -> Result<(), E>,
) -> Result<(), E> {
    items.iter().enumerate().try_for_each(|(place, item)| hand_on(work(place, item)))
}

fn pick<'a, T>(items: &'a [T], next: &AtomicUsize) -> Option<(usize, &'a T)> {
    let place = next.fetch_add(1, Ordering::Relaxed);
    Some((place, items.get(place)?))
}

#[cfg(test)]
mod tests {
    use std::sync::Barrier;
    use std::time::Duration;

    use super::*;

    #[test]
    fn results_are_in_order_for_any_timing() {
        let items: Vec<u64> = (0..40).collect();
        let slow_at_first = |_: usize, &item: &u64| {
            thread::sleep(Duration::from_millis(if item % 4 == 0 { 5 } else { 0 }));
            item
        };
        let mut found = Vec::new();
        let done: Result<(), ()> = in_order(3, &items, slow_at_first, |item| {
            found.push(item);
            Ok(())
        });
        assert_eq!((done, found), (Ok(()), items));
    }

    #[test]
    fn the_first_result_is_returned_before_the_last_is_computed() {
        // The last item waits until the first has been handed on.
        let (items, handed_on) = ([0, 1], Barrier::new(2));
        let wait = |_: usize, &item: &usize| {
            if item == 1 {
                handed_on.wait();
            }
            item
        };
        let done: Result<(), ()> = in_order(2, &items, wait, |item| {
            if item == 0 {
                handed_on.wait();
            }
            Ok(())
        });
        assert_eq!(done, Ok(()));
    }

    #[test]
    fn an_error_of_the_consumer_stops_the_work() {
        let (items, begun) = ([(); 10_000], AtomicUsize::new(0));
        let work = |_: usize, (): &()| {
            thread::sleep(Duration::from_millis(1));
            begun.fetch_add(1, Ordering::Relaxed)
        };
        assert_eq!(in_order(3, &items, work, |_| Err("enough")), Err("enough"));
        assert!(begun.into_inner() < 1000);
    }
}
