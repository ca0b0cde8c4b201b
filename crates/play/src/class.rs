//! The class of a server: learners who have joined it with a name, and where they are. It is in memory only. A learner
//! without a connection is away, and keeps the name until they leave: joining with it again needs its key.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard};

use core::time::Duration;

use crate::lock::lock;
use crate::message::{ClassMember, ClassPlace, ClassRoll};
use crate::refusal::Refused;
use nbc_base::diag::is_hidden;

const MOST: usize = 60;
/// The most names that are taken, including those of learners who are away.
const MOST_NAMES: usize = 600;
const LONGEST: usize = 24;
const LESSON: usize = 64;

#[derive(Debug)]
pub struct Class {
    /// Gives a key that nobody can guess; `None` if the system has no random numbers.
    new_key: fn() -> Option<String>,
    members: Mutex<Members>,
}

#[derive(Debug, Default)]
struct Members {
    last: u64,
    joined: BTreeMap<u64, Member>,
    /// The keys of the taken names, by their lower-case endings.
    keys: BTreeMap<String, String>,
}

#[derive(Debug)]
struct Member {
    name: String,
    place: Option<ClassPlace>,
    finished: u32,
    since: Duration,
}

/// A learner's place in the class. Dropping it marks the learner as away.
#[derive(Debug)]
pub(super) struct Membership {
    class: Arc<Class>,
    number: u64,
    ending: String,
    key: String,
}

impl Class {
    pub fn new(new_key: fn() -> Option<String>) -> Self {
        Self { new_key, members: Mutex::default() }
    }

    fn lock(&self) -> MutexGuard<'_, Members> {
        lock(&self.members)
    }

    /// The key of a name takes it over from another page.
    pub(super) fn join(self: &Arc<Self>, name: &str, key: Option<&str>, now: Duration) -> Result<Membership, Refused> {
        let name = name.trim();
        if name.is_empty() || name.chars().count() > LONGEST || name.contains(|c| c == '\n' || is_hidden(c)) {
            return Err(Refused::ClassName { most: LONGEST });
        }
        let ending = ending(name);
        let own = ending.to_lowercase();
        let mut members = self.lock();
        let key = match members.keys.get(&own) {
            Some(known) if key == Some(known) => known.clone(),
            Some(_) => return Err(Refused::ClassNameTaken { name: name.to_owned() }),
            None if members.keys.len() >= MOST_NAMES => return Err(Refused::ClassFull { most: MOST }),
            None => (self.new_key)().ok_or(Refused::Internal)?,
        };
        members.joined.retain(|_, member| self::ending(&member.name).to_lowercase() != own);
        if members.joined.len() >= MOST {
            return Err(Refused::ClassFull { most: MOST });
        }
        members.keys.insert(own, key.clone());
        members.last += 1;
        let number = members.last;
        let member = Member { name: name.to_owned(), place: None, finished: 0, since: now };
        members.joined.insert(number, member);
        Ok(Membership { class: self.clone(), number, ending, key })
    }

    pub fn roll(&self, now: Duration) -> ClassRoll {
        let seen = |member: &Member| ClassMember {
            name: member.name.clone(),
            place: member.place.clone(),
            finished: member.finished,
            seconds: now.saturating_sub(member.since).as_secs(),
        };
        let mut members: Vec<_> = self.lock().joined.values().map(seen).collect();
        members.sort_by_cached_key(|member| member.name.to_lowercase());
        ClassRoll { members, most: MOST }
    }
}

/// The ending of the names of a learner's files, before `.nb`; no two learners have the same.
fn ending(name: &str) -> String {
    let letters = name.chars().map(|c| if c.is_alphanumeric() { c } else { '_' });
    format!(".{}", letters.collect::<String>())
}

impl Membership {
    pub(super) fn key(&self) -> &str {
        &self.key
    }

    /// Gives up the name, unless another page has taken it over.
    pub(super) fn leave(self) {
        let mut members = self.class.lock();
        if members.joined.contains_key(&self.number) {
            members.keys.remove(&self.ending.to_lowercase());
        }
    }

    pub(super) fn own_path(&self, path: &str) -> String {
        let stem = path.strip_suffix(".nb").unwrap_or(path);
        format!("{}{}.nb", stem.strip_suffix(&self.ending).unwrap_or(stem), self.ending)
    }

    /// A name that no lesson can have counts as no lesson.
    pub(super) fn progress(&self, place: Option<ClassPlace>, finished: u32, now: Duration) {
        let is_name = |name: &str| name.len() <= LESSON && !name.contains(is_hidden);
        let place = place.filter(|place| is_name(&place.lesson));
        if let Some(member) = self.class.lock().joined.get_mut(&self.number) {
            if member.place != place {
                member.since = now;
            }
            (member.place, member.finished) = (place, finished);
        }
    }
}

impl Drop for Membership {
    fn drop(&mut self) {
        self.class.lock().joined.remove(&self.number);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const START: Duration = Duration::ZERO;

    fn class() -> Arc<Class> {
        use std::sync::atomic::{AtomicU64, Ordering};
        static KEYS: AtomicU64 = AtomicU64::new(0);
        Arc::new(Class::new(|| Some(KEYS.fetch_add(1, Ordering::Relaxed).to_string())))
    }

    fn names(class: &Class) -> Vec<String> {
        class.roll(START).members.into_iter().map(|member| member.name).collect()
    }

    #[test]
    fn learners_join_with_a_name_of_their_own_and_leave() {
        let class = class();
        let join = |name: &str| class.join(name, None, START);
        let ada = join(" Ada ").unwrap();
        let _ben = join("ben").unwrap();
        assert_eq!(names(&class), ["Ada", "ben"]);
        assert!(matches!(join("ada"), Err(Refused::ClassNameTaken { .. })));
        for name in ["", " ", "a\nb", "a\u{202e}b", "\u{1b}[2J", &"x".repeat(LONGEST + 1)] {
            assert!(matches!(join(name), Err(Refused::ClassName { .. })), "{name:?}");
        }
        assert!(join(&"é".repeat(LONGEST)).is_ok());
        let place = ClassPlace { lesson: "gate".to_owned(), done: 1, size: None };
        ada.progress(Some(place.clone()), 3, START);
        assert_eq!(class.roll(START).members[0].place, Some(place));
        ada.progress(Some(ClassPlace { lesson: "x".repeat(65), done: 1, size: None }), 3, Duration::from_secs(9));
        assert_eq!(class.roll(START).members[0].place, None);
        drop(ada);
        assert_eq!(names(&class), ["ben"]);
    }

    #[test]
    fn the_name_of_a_learner_who_is_away_stays_theirs() {
        let class = class();
        let ada = class.join("Ada", None, START).unwrap();
        let key = ada.key().to_owned();
        drop(ada);
        for other in [None, Some(""), Some("0123")] {
            assert!(matches!(class.join("ADA", other, START), Err(Refused::ClassNameTaken { .. })), "{other:?}");
        }
        let first = class.join("Ada", Some(&key), START).unwrap();
        let reloaded = class.join("Ada", Some(&key), START).unwrap();
        assert_eq!(names(&class), ["Ada"], "a page that is reloaded comes before the old one has gone");
        drop(first);
        assert_eq!(names(&class), ["Ada"]);
        reloaded.leave();
        let other = class.join("ada", None, START).unwrap();
        assert_ne!(other.key(), key, "the name was given up");
        assert!(matches!(class.join("Ada", Some(&key), START), Err(Refused::ClassNameTaken { .. })));
        for number in 1..MOST_NAMES {
            drop(class.join(&number.to_string(), None, START).unwrap());
        }
        assert!(matches!(class.join("one more", None, START), Err(Refused::ClassFull { most: MOST })));
    }

    #[test]
    fn each_learner_has_paths_of_their_own() {
        let class = class();
        let ada = class.join("Ada L.", None, START).unwrap();
        for path in ["a/latch.nb", "a/latch.Ada_L_.nb"] {
            assert_eq!(ada.own_path(path), "a/latch.Ada_L_.nb");
        }
        assert_eq!(class.join("A. b", None, START).unwrap().own_path("latch.Ada_L_.nb"), "latch.Ada_L_.A__b.nb");
        assert!(
            matches!(class.join("ada/l?", None, START), Err(Refused::ClassNameTaken { .. })),
            "their files would be the same"
        );
    }

    #[test]
    fn a_class_has_an_end() {
        let class = class();
        let all: Vec<_> = (0..MOST).map(|number| class.join(&number.to_string(), None, START).unwrap()).collect();
        assert!(matches!(class.join("one more", None, START), Err(Refused::ClassFull { most: MOST })));
        drop(all);
        assert!(class.join("one more", None, START).is_ok());
    }
}
