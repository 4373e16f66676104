//! Results so far: answers to the parts of questions, and so to the questions.

use super::split::Split;
use super::{Means, Reply};

/// Callback for an answer as soon as it is known: number of the question, answer, techniques.
pub(super) type Tell<'t> = &'t mut (dyn FnMut(usize, &Reply, &[Means]) + 't);

/// The questions and the answers to their parts.
pub(super) struct Ledger<'q, 't> {
    splits: Vec<Split<'q>>,
    replies: Vec<Option<Reply>>,
    means: Vec<Means>,
    is_told: Vec<bool>,
    tell: Tell<'t>,
}

impl<'q, 't> Ledger<'q, 't> {
    /// Starts with no answer to any part.
    pub(super) fn new(splits: Vec<Split<'q>>, parts: usize, tell: Tell<'t>) -> Self {
        let is_told = vec![false; splits.len()];
        let mut ledger =
            Self { splits, replies: vec![None; parts], means: vec![Means::Exploration; parts], is_told, tell };
        ledger.tell();
        ledger
    }

    /// Records the answer to a part.
    pub(super) fn put(&mut self, part: usize, reply: Reply, by: Means) {
        (self.replies[part], self.means[part]) = (Some(reply), by);
        self.tell();
    }

    fn tell(&mut self) {
        for (number, split) in self.splits.iter().enumerate() {
            if !self.is_told[number]
                && let Some(reply) = split.reply(&self.replies)
            {
                self.is_told[number] = true;
                (self.tell)(number, &reply, &split.means(&self.replies, &self.means));
            }
        }
    }

    /// Unanswered parts that an open question still depends on, ascending.
    pub(super) fn open(&self) -> Vec<usize> {
        let mut open = Vec::new();
        for split in self.splits.iter().filter(|split| split.reply(&self.replies).is_none()) {
            split.for_each_part(&mut |part| open.push(part));
        }
        open.retain(|&part| self.replies[part].is_none());
        open.sort_unstable();
        open.dedup();
        open
    }

    /// Final answers with their techniques. Open questions are reported now, with their own reason or this one.
    pub(super) fn close(self, reason: &str) -> (Vec<Reply>, Vec<Vec<Means>>) {
        let Self { splits, replies, means, is_told, tell } = self;
        let answer = |(number, split): (usize, &Split<'_>)| {
            let unknown = || Reply::Unknown(split.reason(&replies).unwrap_or(reason).to_owned());
            let (reply, means) = (split.reply(&replies).unwrap_or_else(unknown), split.means(&replies, &means));
            if !is_told[number] {
                tell(number, &reply, &means);
            }
            (reply, means)
        };
        splits.iter().enumerate().map(answer).unzip()
    }
}
