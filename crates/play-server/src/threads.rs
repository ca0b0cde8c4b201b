//! The shell of the pages: a thread for each long work, and the files that pages are to fetch.

use std::sync::Arc;
use std::thread;

use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::lesson_source::LessonSource;
use crate::takes::Takes;
use nbc_play::{LessonTexts, Portion, Portions, Shell, WorkKind};

pub(super) struct Threads {
    lessons: Vec<LessonSource>,
    pub(super) takes: Takes,
    pools: Arc<Pools>,
}

struct Pools {
    /// Threads for searches and measurements, so that swarms never wait for these.
    background: ThreadPool,
    /// A thread for bodies in the designer, which do not wait for the search of another page.
    probing: ThreadPool,
}

impl Threads {
    pub(super) fn new(lessons: &[LessonSource]) -> Self {
        let lessons = if lessons.is_empty() { vec![LessonSource::Shipped] } else { lessons.to_vec() };
        let cores = thread::available_parallelism().map_or(1, std::num::NonZero::get);
        let pool = |threads| ThreadPoolBuilder::new().num_threads(threads).build().expect("the system has threads");
        let pools = Pools { background: pool((cores - 1).max(1)), probing: pool(1) };
        Self { lessons, takes: Takes::default(), pools: Arc::new(pools) }
    }
}

impl Pools {
    fn portion(&self, kind: WorkKind, portions: &mut Portions) -> Portion {
        match kind {
            WorkKind::Check | WorkKind::Program => portions(),
            WorkKind::Probe => self.probing.install(portions),
            WorkKind::Search => self.background.install(portions),
        }
    }
}

impl Shell for Threads {
    fn start(&self, kind: WorkKind, mut portions: Portions) {
        let pools = self.pools.clone();
        thread::spawn(move || while pools.portion(kind, &mut portions) != Portion::Done {});
    }

    fn keep(&self, name: &str, media_type: &'static str, bytes: Vec<u8>) -> String {
        self.takes.keep(name, media_type, bytes)
    }

    fn template(&self) -> Option<Arc<str>> {
        nbc_play::live_template().map(Into::into)
    }

    fn lessons(&self) -> Vec<LessonTexts> {
        self.lessons.iter().map(LessonSource::texts).collect()
    }
}
