//! The threads that simulations share: as many as the machine has cores, or as `RAYON_NUM_THREADS` says; fewer if the
//! system cannot start them.

use std::env;
use std::sync::mpsc::{self, SyncSender};
use std::thread::{self, JoinHandle};

use rayon::{ThreadBuilder, ThreadPoolBuilder};

use crate::cli::wording;
use crate::cli::{Context, Failure};

const VARIABLE: &str = "RAYON_NUM_THREADS";
const MOST: usize = 1024;

/// If the system cannot start all threads, there are fewer and a warning is logged. Results do not depend on the
/// number.
pub(super) fn start(context: &Context) -> Result<(), Failure> {
    let wanted = wanted(env::var_os(VARIABLE).map(|value| value.to_string_lossy().into_owned()).as_deref())?;
    let mut idle: Vec<Idle> = (0..wanted).map_while(|_| Idle::start()).collect();
    if idle.len() < wanted {
        // The work itself needs the other half.
        idle.drain(idle.len() / 2..).for_each(Idle::end);
        context.log(&format!(
            "{} of {wanted} threads are used, because the system cannot start more\n",
            idle.len().max(1)
        ));
    }
    let found = idle.len();
    let pool = ThreadPoolBuilder::new().num_threads(found.max(1));
    let built = match found {
        // The current thread does all the work.
        0 => pool.use_current_thread().build_global(),
        _ => {
            let hand_out = |work| {
                if let Some(thread) = idle.pop() {
                    thread.work(work);
                }
                Ok(())
            };
            pool.spawn_handler(hand_out).build_global()
        }
    };
    // In a program that calls this twice, the threads of the first call stay.
    let _ = built;
    Ok(())
}

fn wanted(value: Option<&str>) -> Result<usize, Failure> {
    let cores = || thread::available_parallelism().map_or(1, usize::from);
    match value.map(str::trim) {
        None | Some("") => Ok(cores()),
        Some(digits) if digits.bytes().all(|byte| byte.is_ascii_digit()) => match digits.parse().unwrap_or(MOST) {
            0 => Ok(cores()),
            // A number that is too long to be read is above the limit, too.
            number => Ok(number.min(MOST)),
        },
        Some(other) => Err(wording::threads(VARIABLE, other).into()),
    }
}

/// A thread that waits for work from the pool.
struct Idle {
    work: SyncSender<ThreadBuilder>,
    thread: JoinHandle<()>,
}

impl Idle {
    /// `None` if the system cannot start another thread.
    fn start() -> Option<Self> {
        let (sender, work) = mpsc::sync_channel::<ThreadBuilder>(1);
        let wait = move || {
            if let Ok(work) = work.recv() {
                work.run();
            }
        };
        let thread = thread::Builder::new().spawn(wait).ok()?;
        Some(Self { work: sender, thread })
    }

    fn work(self, work: ThreadBuilder) {
        self.work.send(work).expect("an idle thread waits for its work");
    }

    fn end(self) {
        drop(self.work);
        self.thread.join().expect("a thread without work ends");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_accepted_and_words_rejected() {
        assert_eq!([Some("3"), Some(" 7 "), Some("99999999999999999999999")].map(|v| wanted(v).unwrap()), [3, 7, MOST]);
        let cores = wanted(None).unwrap();
        assert!(cores > 0);
        assert_eq!([Some(""), Some("0"), Some("00")].map(|v| wanted(v).unwrap()), [cores; 3]);
        assert!(["two", "-1", "1.5", "0x4"].iter().all(|word| wanted(Some(word)).is_err()));
    }
}
