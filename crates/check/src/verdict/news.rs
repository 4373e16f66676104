//! Progressive results of a check: each answer as soon as it and all before it are known.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use super::{Answer, Report};

/// Event of a running check; each is final.
#[derive(Clone, Copy, Debug)]
pub enum News<'a> {
    /// Exploration finished: figures and assumptions, as a report without answers.
    Explored(&'a Report),
    /// Answer to the requirement at this position. Answers come in the order of the requirements, after
    /// [`News::Explored`].
    Answered(usize, &'a Answer),
}

/// Listener. Calls come from several threads, one at a time.
pub type Tell<'a> = &'a (dyn Fn(News<'_>) + Sync);

/// Holds answers back until all before them have been reported.
pub struct InOrder<'a> {
    tell: Option<Tell<'a>>,
    waiting: Mutex<Waiting>,
}

#[derive(Default)]
struct Waiting {
    has_begun: bool,
    /// Next position to report.
    next: usize,
    answers: BTreeMap<usize, Answer>,
}

impl<'a> InOrder<'a> {
    /// Starts with nothing reported.
    pub fn new(tell: Option<Tell<'a>>) -> Self {
        Self { tell, waiting: Mutex::default() }
    }

    /// Reports the exploration, once, and the answers that waited for it.
    pub fn begin(&self, report: impl FnOnce() -> Report) {
        let Some(tell) = self.tell else { return };
        let mut waiting = self.waiting.lock().unwrap_or_else(PoisonError::into_inner);
        if !waiting.has_begun {
            waiting.has_begun = true;
            tell(News::Explored(&report()));
            waiting.flush(tell);
        }
    }

    /// Reports the answer at a position, or holds it back.
    pub fn put(&self, position: usize, answer: impl FnOnce() -> Answer) {
        let Some(tell) = self.tell else { return };
        let answer = answer();
        let mut waiting = self.waiting.lock().unwrap_or_else(PoisonError::into_inner);
        waiting.answers.insert(position, answer);
        if waiting.has_begun {
            waiting.flush(tell);
        }
    }
}

impl Waiting {
    fn flush(&mut self, tell: Tell<'_>) {
        while let Some(answer) = self.answers.remove(&self.next) {
            tell(News::Answered(self.next, &answer));
            self.next += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use super::{InOrder, News};
    use crate::verdict::{Answer, Exploration, Outcome, Report};

    fn answer(name: &str) -> Answer {
        Answer::of_check(name, "", "", Outcome::holds())
    }

    fn report() -> Report {
        let exploration = Exploration {
            view: petril_logic::View::Scan,
            states: 0,
            steps: 0,
            depth: 0,
            complete: true,
            stop: petril_search::Stop::Complete,
            bytes: 0,
            recalled: false,
        };
        let (answers, checks, remarks, assumptions) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Report { exploration, assumptions, answers, checks, remarks, warnings: Vec::new(), coverage: None }
    }

    #[test]
    fn answers_wait_for_those_before_them() {
        let heard = Mutex::new(Vec::new());
        let tell = |news: News<'_>| {
            heard.lock().unwrap().push(match news {
                News::Explored(_) => "explored".to_owned(),
                News::Answered(position, answer) => format!("{position} {}", answer.name),
            });
        };
        let order = InOrder::new(Some(&tell));
        order.put(0, || answer("a"));
        assert!(heard.lock().unwrap().is_empty(), "nothing is told before what was explored");
        order.put(2, || answer("c"));
        order.begin(report);
        assert_eq!(*heard.lock().unwrap(), ["explored", "0 a"]);
        order.begin(report);
        order.put(1, || answer("b"));
        assert_eq!(*heard.lock().unwrap(), ["explored", "0 a", "1 b", "2 c"]);
    }
}
