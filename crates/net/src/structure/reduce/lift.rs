//! Lifting runs of the reduced net to runs of the original, by undoing the logged steps in reverse order.

use std::collections::VecDeque;
use std::fmt;

use super::log::{Around, Log, Step};
use super::{Property, Reduced};
use crate::net::{Net, TransitionId};

/// Reason why a run could not be lifted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LiftError {
    /// Not a run of the reduced net: the firing at this position is not enabled.
    NoRun(usize),
    /// The run of the original would have more firings than this limit.
    TooLong(usize),
    /// The replay on the original net refutes the lifted run. This would be an error in Petril.
    Refuted(String),
}

impl fmt::Display for LiftError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoRun(position) => write!(f, "firing {} is not enabled in the reduced net", position + 1),
            Self::TooLong(most) => write!(f, "in the original net, the run has more than {most} firings"),
            Self::Refuted(what) => write!(f, "the replay refutes a run of the reduced net: {what}"),
        }
    }
}

impl std::error::Error for LiftError {}

/// Maximum number of firings of a lifted run.
const LONGEST: usize = 10_000_000;

const TOO_LONG: LiftError = LiftError::TooLong(LONGEST);

/// Lifts a run and replays it; see [`Reduced::lift`].
pub(super) fn lift(reduced: &Reduced<'_>, run: &[TransitionId]) -> Result<Vec<TransitionId>, LiftError> {
    let mut numbers = VecDeque::with_capacity(run.len());
    for (position, &id) in run.iter().enumerate() {
        numbers.push_back(*reduced.numbers.get(id.index()).ok_or(LiftError::NoRun(position))?);
    }
    let last = replay(&reduced.net, run).map_err(LiftError::NoRun)?;
    let lifted = undo(&reduced.log, numbers)?;
    let lifted: Vec<TransitionId> = lifted.into_iter().map(|number| TransitionId::at(number as usize)).collect();
    let refuted = |what: String| Err(LiftError::Refuted(what));
    let end = match replay(reduced.original, &lifted) {
        Ok(end) => end,
        Err(position) => return refuted(format!("firing {} is not enabled", position + 1)),
    };
    for &place in &reduced.kept {
        let seen = reduced.place(place).map(|id| last[id.index()]);
        if seen != Some(end[place.index()]) {
            return refuted(format!("`{}` has other tokens", reduced.original.place(place).name));
        }
    }
    if reduced.property == Property::Deadlock && is_dead(&reduced.net, &last) && !is_dead(reduced.original, &end) {
        return refuted("the last marking is not dead".to_owned());
    }
    Ok(lifted)
}

/// Returns the last marking of a run, or the position of a firing that is not enabled.
fn replay(net: &Net, run: &[TransitionId]) -> Result<Vec<u64>, usize> {
    let mut tokens: Vec<u64> = net.places().map(|place| place.tokens).collect();
    for (position, &id) in run.iter().enumerate() {
        if !is_enabled(net, &tokens, id) {
            return Err(position);
        }
        net.taken(id).for_each(|(place, weight)| tokens[place.index()] -= weight);
        for (place, weight) in net.put(id) {
            let on = &mut tokens[place.index()];
            *on = on.checked_add(weight).ok_or(position)?;
        }
    }
    Ok(tokens)
}

fn is_enabled(net: &Net, tokens: &[u64], id: TransitionId) -> bool {
    net.pre(id).all(|(place, weight)| tokens[place.index()] >= weight)
}

fn is_dead(net: &Net, tokens: &[u64]) -> bool {
    !net.transition_ids().any(|id| is_enabled(net, tokens, id))
}

/// Undoes the steps of a log in reverse order.
fn undo(log: &Log, mut run: VecDeque<u32>) -> Result<VecDeque<u32>, LiftError> {
    // Number of firings of each transition that existed when the step to be undone was taken.
    let mut counts = vec![0_u64; log.originals + log.words.len()];
    run.iter().for_each(|&id| counts[id as usize] += 1);
    for (transitions, step) in log.steps.iter().rev() {
        for id in (*transitions..counts.len()).rev() {
            for &part in log.meaning(id as u32).unwrap_or_default() {
                counts[part as usize] = counts[part as usize].checked_add(counts[id]).ok_or(TOO_LONG)?;
            }
        }
        counts.truncate(*transitions);
        match step {
            Step::Begun { transition, times } => {
                if run.len() as u64 + times > LONGEST as u64 {
                    return Err(TOO_LONG);
                }
                (0..*times).for_each(|_| run.push_front(*transition));
                counts[*transition as usize] = counts[*transition as usize].checked_add(*times).ok_or(TOO_LONG)?;
            }
            Step::Finished { last, around } => {
                for (id, times) in finish(last, around, &counts)? {
                    if run.len() as u64 + times > LONGEST as u64 {
                        return Err(TOO_LONG);
                    }
                    (0..times).for_each(|_| run.push_back(id));
                    counts[id as usize] = counts[id as usize].checked_add(times).ok_or(TOO_LONG)?;
                }
            }
            Step::Fused { moves, around } => {
                run = route(moves, around, &spelled(log, run, *transitions)?)?;
                counts.fill(0);
                run.iter().for_each(|&id| counts[id as usize] += 1);
            }
            Step::Supplied { transition, around } => {
                run = spelled(log, run, *transitions)?;
                let times = supply(*transition, around, &run)?;
                if run.len() as u64 + times > LONGEST as u64 {
                    return Err(TOO_LONG);
                }
                (0..times).for_each(|_| run.push_front(*transition));
                counts.fill(0);
                run.iter().for_each(|&id| counts[id as usize] += 1);
            }
        }
    }
    spelled(log, run, log.originals)
}

/// Returns a run in which the transitions from number `first` on are written out.
fn spelled(log: &Log, run: VecDeque<u32>, first: usize) -> Result<VecDeque<u32>, LiftError> {
    let mut out = VecDeque::with_capacity(run.len());
    let mut stack: Vec<u32> = Vec::new();
    for id in run {
        stack.push(id);
        while let Some(id) = stack.pop() {
            match log.meaning(id).filter(|_| id as usize >= first) {
                Some(word) => stack.extend(word.iter().rev()),
                None => out.push_back(id),
            }
        }
        if out.len() > LONGEST {
            return Err(TOO_LONG);
        }
    }
    Ok(out)
}

/// Number of times that transitions with disjoint presets can fire at the end of a run.
fn finish(last: &[u32], around: &Around, counts: &[u64]) -> Result<Vec<(u32, u64)>, LiftError> {
    let mut tokens: Vec<i128> = around.tokens.iter().map(|&tokens| i128::from(tokens)).collect();
    for (id, pre, post) in &around.transitions {
        let times = i128::from(counts[*id as usize]);
        let mut change = |row: &[(u32, u64)], sign: i128| -> Option<()> {
            for &(place, weight) in row {
                let change = times.checked_mul(i128::from(weight))?.checked_mul(sign)?;
                tokens[place as usize] = tokens[place as usize].checked_add(change)?;
            }
            Some(())
        };
        change(pre, -1).and_then(|()| change(post, 1)).ok_or(TOO_LONG)?;
    }
    let times = |&id: &u32| {
        let (pre, _) = around.get(id)?;
        let times = pre.iter().map(|&(place, weight)| tokens[place as usize] / i128::from(weight)).min()?;
        Some((id, u64::try_from(times).ok()?))
    };
    let lost = || LiftError::Refuted("tokens are missing at the end".to_owned());
    last.iter().map(|id| times(id).ok_or_else(lost)).collect()
}

/// Number of times that a transition must fire initially so that its places never lack tokens.
fn supply(transition: u32, around: &Around, run: &VecDeque<u32>) -> Result<u64, LiftError> {
    let mut tokens: Vec<i128> = around.tokens.iter().map(|&tokens| i128::from(tokens)).collect();
    let mut short: Vec<i128> = vec![0; tokens.len()];
    for &id in run {
        let Some((pre, post)) = around.get(id) else { continue };
        for &(place, weight) in pre {
            let place = place as usize;
            short[place] = short[place].max(i128::from(weight) - tokens[place]);
            tokens[place] -= i128::from(weight);
        }
        post.iter().for_each(|&(place, weight)| tokens[place as usize] += i128::from(weight));
    }
    let (pre, post) = around.get(transition).ok_or_else(|| LiftError::Refuted("a supply is lost".to_owned()))?;
    let gain = |place: usize| {
        let on = |row: &[(u32, u64)]| row.iter().find(|arc| arc.0 as usize == place).map_or(0, |arc| i128::from(arc.1));
        on(post) - on(pre)
    };
    let mut times =
        short.iter().enumerate().filter(|(_, short)| **short > 0).map(|(place, &short)| match gain(place) {
            gain @ 1.. => Some((short + gain - 1) / gain),
            _ => None,
        });
    let times = times.try_fold(0, |most, times| times.map(|times| times.max(most)));
    let times = times.ok_or_else(|| LiftError::Refuted("a supply is too small".to_owned()))?;
    u64::try_from(times).map_err(|_| TOO_LONG)
}

/// Returns a run with the moves between fused places inserted that each firing needs.
fn route(moves: &[(usize, usize, u32)], around: &Around, run: &VecDeque<u32>) -> Result<VecDeque<u32>, LiftError> {
    let mut into: Vec<Vec<(usize, u32)>> = vec![Vec::new(); around.tokens.len()];
    moves.iter().for_each(|&(from, to, id)| into[to].push((from, id)));
    let mut tokens = around.tokens.clone();
    let mut out = VecDeque::with_capacity(run.len());
    for &id in run {
        if let Some((pre, post)) = around.get(id) {
            let needed = |place: usize| pre.iter().find(|arc| arc.0 as usize == place).map_or(0, |arc| arc.1);
            for &(place, weight) in pre {
                while tokens[place as usize] < weight {
                    let way = nearest(&into, place as usize, &|from| tokens[from] > needed(from));
                    let (from, way) = way.ok_or_else(|| LiftError::Refuted("fused places lack tokens".to_owned()))?;
                    tokens[from] -= 1;
                    tokens[place as usize] += 1;
                    out.extend(way);
                    if out.len() > LONGEST {
                        return Err(TOO_LONG);
                    }
                }
            }
            pre.iter().for_each(|&(place, weight)| tokens[place as usize] -= weight);
            for &(place, weight) in post {
                let on = &mut tokens[place as usize];
                *on = on.checked_add(weight).ok_or(TOO_LONG)?;
            }
        }
        out.push_back(id);
        if out.len() > LONGEST {
            return Err(TOO_LONG);
        }
    }
    Ok(out)
}

/// Finds the nearest place that can spare a token for another one, and the moves that bring it there.
fn nearest(into: &[Vec<(usize, u32)>], to: usize, can_spare: &dyn Fn(usize) -> bool) -> Option<(usize, Vec<u32>)> {
    // For each place seen, the move out of it and the place it leads to.
    let mut next: Vec<Option<(u32, usize)>> = vec![None; into.len()];
    let mut waiting = VecDeque::from([to]);
    while let Some(place) = waiting.pop_front() {
        for &(from, id) in &into[place] {
            if from == to || next[from].is_some() {
                continue;
            }
            next[from] = Some((id, place));
            if can_spare(from) {
                let steps = std::iter::successors(Some(from), |&at| next[at].map(|(_, to)| to));
                return Some((from, steps.map_while(|at| next[at]).map(|(id, _)| id).collect()));
            }
            waiting.push_back(from);
        }
    }
    None
}
