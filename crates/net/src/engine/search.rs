//! Breadth-first search of a net's states, level by level, on one or more threads.
//!
//! Each thread owns a shard of the states, by hash, and sends states of other shards to their owners. Small levels are
//! expanded by one thread. Counts and distances do not depend on the number of threads.

use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Condvar, Mutex, OnceLock};
use std::thread;

use super::cover::Bounds;
use super::machine::Machine;
use super::model::{MANY, Model, Rule};
use super::shard::{Counts, Halt, Letter, Shard, Task};
use super::stubborn::Stubborn;
use super::view::View;
use super::{Exploration, Figures};
use crate::Goal;
use petril_search::{Budget, Progress, Stop};

/// Options of an exploration.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Limits of the search.
    pub budget: Budget,
    /// Number of threads; 0 counts as 1.
    pub threads: usize,
    /// Whether states are kept, so that firing sequences can be reconstructed: about 12 bytes more per state.
    pub keep: bool,
}

impl Default for Options {
    /// Options with one thread, the default budget, and no states kept.
    fn default() -> Self {
        Self { budget: Budget::default(), threads: 1, keep: false }
    }
}

/// Predicate that ends a search at the state looked for.
pub trait Wanted: Sync {
    /// Whether a state is the one looked for. Called once for each expanded state, by any thread.
    fn is(&self, view: &View<'_>) -> bool;

    /// Called when the search restarts from the initial state. The states seen before are discarded.
    fn forget(&self) {}
}

impl<F: Fn(&View<'_>) -> bool + Sync> Wanted for F {
    fn is(&self, view: &View<'_>) -> bool {
        self(view)
    }
}

/// Number of states expanded before a thread reads its messages and checks the budget.
const BLOCK: usize = 512;

/// Number of states below which a level is expanded by one thread.
const NARROW: usize = 4096;

/// Number of words at which a message is sent.
const LETTER: usize = 2048;

/// Explores a net until every state is found, the budget is used up, `watch` returns a reason to stop, or `wanted` is
/// true of a state. `watch` is called every few thousand states. States are tested in the order of their distances, so
/// the one found is a nearest one; which of several nearest ones is found can depend on the number of threads.
///
/// Places without a bound by an invariant get few bits at first; if these overflow, the search restarts with more.
pub fn explore(
    model: &Model,
    options: &Options,
    watch: &mut dyn FnMut(&Progress) -> Option<String>,
    wanted: Option<&dyn Wanted>,
) -> Exploration {
    match model.rules() {
        Ok(rules) => {
            let bounds = Bounds::of(&model.initial, &rules);
            explore_within(model, &rules, &bounds, options, watch, wanted, None)
        }
        Err(reason) => Exploration::refused(reason),
    }
}

/// Explores a net until a goal marking is found, there can be none, or the budget or `watch` ends the search. Only
/// stubborn sets for the goal are fired, so the figures are those of a part of the states. The marking found is still a
/// nearest one.
pub fn explore_towards(
    model: &Model,
    options: &Options,
    watch: &mut dyn FnMut(&Progress) -> Option<String>,
    goal: &Goal,
) -> Exploration {
    let rules = match model.rules() {
        Ok(rules) => rules,
        Err(reason) => return Exploration::refused(reason),
    };
    let (stubborn, bounds) = (Stubborn::of(goal, &rules, model.initial.len()), Bounds::of(&model.initial, &rules));
    explore_within(model, &rules, &bounds, options, watch, Some(&|view: &View<'_>| goal.holds(view)), Some(&stubborn))
}

/// Explores a net as [`explore`] does, with known rules and bounds; towards a goal, if there are stubborn sets for one.
pub(super) fn explore_within(
    model: &Model,
    rules: &[Rule],
    bounds: &Bounds,
    options: &Options,
    watch: &mut dyn FnMut(&Progress) -> Option<String>,
    wanted: Option<&dyn Wanted>,
    stubborn: Option<&Stubborn<'_>>,
) -> Exploration {
    let mut limits: Vec<u64> = model.initial.iter().map(|&tokens| tokens.max(1)).collect();
    for round in 0.. {
        let machine = Machine::new(&model.initial, rules, bounds, &limits);
        let shards = options.threads.max(1);
        let task = Task { machine: &machine, wanted, stubborn, shards, keep: options.keep };
        let mut search = Search::new(task, options.budget);
        let end = search.run(watch);
        let End::Overflow(words) = end else {
            let shards = std::mem::take(&mut search.shards);
            return finish(model, rules, machine, shards, end, options.keep);
        };
        if let Some(wanted) = wanted {
            wanted.forget();
        }
        if !raise(&mut limits, &machine, rules, &words, round) {
            break;
        }
    }
    Exploration::refused("a place has 2^62 tokens or more".to_owned())
}

/// Raises the limits of the places that overflow by the firings enabled in a marking, after some rounds those of all
/// places without a bound. Returns whether that is possible.
fn raise(limits: &mut [u64], machine: &Machine, rules: &[Rule], words: &[u64], round: usize) -> bool {
    let tokens = |place| machine.packing.tokens(words, place);
    let all = round >= 8;
    let mut most = vec![0; limits.len()];
    for touch in rules.iter().filter(|rule| rule.iter().all(|touch| tokens(touch.place) >= touch.pre)).flatten() {
        most[touch.place] = most[touch.place].max(tokens(touch.place).saturating_add_signed(touch.change()));
    }
    for (place, limit) in machine.packing.unproven() {
        if most[place] > limit || all {
            limits[place] = most[place].max(limit * 2).next_power_of_two().saturating_mul(2) - 1;
        }
    }
    limits.iter().all(|&limit| limit < MANY)
}

fn finish(model: &Model, rules: &[Rule], machine: Machine, shards: Vec<Shard>, end: End, keep: bool) -> Exploration {
    let mut counts = Counts::default();
    let mut seen = machine.meter.nothing(machine.width);
    let mut figures = Figures::default();
    for shard in &shards {
        seen.merge(&shard.seen);
        figures.states += shard.len() as u64;
        figures.bytes += shard.bytes();
        counts.expanded += shard.counts.expanded;
        counts.fired += shard.counts.fired;
        counts.transitions += shard.counts.transitions;
        counts.deadlocks += shard.counts.deadlocks;
        let nearest = counts.deadlock.iter().chain(&shard.counts.deadlock).min().cloned();
        counts.deadlock = nearest;
    }
    let (place_maxima, tokens) = machine.meter.maxima(&model.initial, rules, &seen);
    let marking = |words: &[u64]| (0..model.initial.len()).map(|place| machine.packing.tokens(words, place)).collect();
    figures.expanded = counts.expanded;
    figures.transitions = counts.transitions;
    figures.fired = counts.fired;
    figures.deadlocks = counts.deadlocks;
    figures.deadlock = counts.deadlock.as_ref().map(|(_, words)| marking(words));
    figures.max_tokens_in_place = place_maxima.iter().copied().max().unwrap_or(0);
    figures.max_tokens_in_marking = tokens;
    figures.place_maxima = place_maxima;
    figures.never_enabled = (0..rules.len()).filter(|&transition| !seen.was_enabled(transition)).collect();
    figures.depth = shards.first().map_or(0, |shard| shard.levels.len().saturating_sub(1));
    figures.bits = machine.packing.bits.iter().sum();
    figures.bytes += machine.bytes();
    let (stop, found) = match end {
        End::Stopped(stop) => (stop, None),
        End::Found(words) | End::Overflow(words) => {
            (Stop::Watcher("a wanted state was found".to_owned()), Some(marking(&words)))
        }
    };
    let shards = if keep { shards } else { Vec::new() };
    Exploration { figures, stop, found, machine, shards, stretches: OnceLock::new() }
}

/// Outcome of a search.
enum End {
    Stopped(Stop),
    Overflow(Vec<u64>),
    Found(Vec<u64>),
}

struct Search<'a> {
    task: Task<'a>,
    shards: Vec<Shard>,
    common: Common,
}

/// State shared by the threads.
struct Common {
    budget: Budget,
    states: AtomicU64,
    expanded: AtomicU64,
    bytes: AtomicU64,
    stopping: AtomicBool,
    end: Mutex<Option<End>>,
    post: Vec<Post>,
    /// Number of shards that still have states of this level to expand.
    busy: AtomicUsize,
}

/// Mailbox of a shard.
#[derive(Default)]
struct Post {
    letters: Mutex<Vec<Letter>>,
    /// Signals a new message, or that no shard is busy any more.
    news: Condvar,
}

impl Common {
    fn stop(&self, end: End) {
        if let Ok(mut place) = self.end.lock() {
            // After an overflow the figures are meaningless.
            if place.is_none() || matches!(end, End::Overflow(_)) {
                *place = Some(end);
            }
        }
        self.stopping.store(true, Ordering::Release);
    }

    fn is_stopping(&self) -> bool {
        self.stopping.load(Ordering::Acquire)
    }

    fn send(&self, to: usize, letter: &mut Letter) {
        if !letter.vias.is_empty()
            && let Ok(mut letters) = self.post[to].letters.lock()
        {
            letters.push(std::mem::take(letter));
            self.post[to].news.notify_one();
        }
    }

    /// Takes the messages to a shard. If `patient`, waits for a message, or until no shard is busy.
    fn letters(&self, to: usize, patient: bool) -> Vec<Letter> {
        let Ok(mut letters) = self.post[to].letters.lock() else { return Vec::new() };
        while patient && letters.is_empty() && self.busy.load(Ordering::Acquire) > 0 {
            let Ok(news) = self.post[to].news.wait(letters) else { return Vec::new() };
            letters = news;
        }
        std::mem::take(&mut letters)
    }

    /// Reports that a shard has expanded all its states of a level, and sent all its messages.
    fn rest(&self) {
        if self.busy.fetch_sub(1, Ordering::AcqRel) == 1 {
            for post in &self.post {
                // A thread that is about to wait holds the lock, and would miss the signal.
                drop(post.letters.lock());
                post.news.notify_one();
            }
        }
    }

    /// Adds the growth of a shard to the totals, and checks the budget.
    fn account(&self, shard: &Shard, before: &mut Progress) {
        let now = Progress {
            states: shard.len() as u64,
            expanded: shard.counts.expanded,
            bytes: shard.bytes(),
            ..Progress::default()
        };
        let add = |sum: &AtomicU64, before: u64, now: u64| {
            let more = now.wrapping_sub(before);
            sum.fetch_add(more, Ordering::Relaxed).wrapping_add(more)
        };
        let states = add(&self.states, before.states, now.states);
        let bytes = add(&self.bytes, before.bytes, now.bytes);
        add(&self.expanded, before.expanded, now.expanded);
        *before = now;
        if states > self.budget.states {
            self.stop(End::Stopped(Stop::States(self.budget.states)));
        } else if bytes > self.budget.bytes || shard.is_full() {
            self.stop(End::Stopped(Stop::Bytes(self.budget.bytes)));
        }
    }

    fn progress(&self, depth: usize) -> Progress {
        Progress {
            states: self.states.load(Ordering::Relaxed),
            expanded: self.expanded.load(Ordering::Relaxed),
            bytes: self.bytes.load(Ordering::Relaxed),
            depth,
        }
    }
}

/// Watcher, called by the thread that began the search before each block of states.
type Watch<'a> = &'a mut (dyn FnMut(&Progress) -> Option<String> + 'a);

impl<'a> Search<'a> {
    fn new(task: Task<'a>, budget: Budget) -> Self {
        let shards: Vec<Shard> = (0..task.shards)
            .map(|number| Shard::new(number, task.machine, budget.bytes / task.shards as u64))
            .collect();
        let common = Common {
            budget,
            states: AtomicU64::new(0),
            expanded: AtomicU64::new(0),
            bytes: AtomicU64::new(0),
            stopping: AtomicBool::new(false),
            end: Mutex::new(None),
            post: shards.iter().map(|_| Post::default()).collect(),
            busy: AtomicUsize::new(0),
        };
        Self { task, shards, common }
    }

    fn run(&mut self, watch: Watch<'_>) -> End {
        let machine = self.task.machine;
        let root = Letter { words: machine.initial.clone(), vias: vec![machine.transitions as u32] };
        self.shards[super::shard::owner(&machine.initial, self.task.shards)].receive(&root);
        let mut accounts = vec![Progress::default(); self.shards.len()];
        loop {
            // A shard may have received states after its last check.
            if self.shards.iter().any(Shard::is_full) {
                return End::Stopped(Stop::Bytes(self.common.budget.bytes));
            }
            self.shards.iter_mut().for_each(|shard| shard.begin_level(self.task.keep));
            let waiting: usize = self.shards.iter().map(Shard::waiting).sum();
            if waiting == 0 {
                self.shards.iter_mut().for_each(|shard| _ = shard.levels.pop());
                watch(&self.common.progress(self.shards[0].levels.len()));
                return End::Stopped(Stop::Complete);
            }
            if self.shards.len() == 1 || waiting < NARROW {
                self.level_alone(&mut accounts, watch);
            } else {
                self.level_together(&mut accounts, watch);
            }
            if let Some(end) = self.common.end.lock().ok().and_then(|mut end| end.take()) {
                return end;
            }
        }
    }

    /// Expands all states of a level on this thread.
    fn level_alone(&mut self, accounts: &mut [Progress], watch: Watch<'_>) {
        let Self { task, shards, common } = self;
        let depth = shards[0].levels.len() - 1;
        for (shard, account) in shards.iter_mut().zip(&mut *accounts) {
            let mut letters: Vec<Letter> = (0..task.shards).map(|_| Letter::default()).collect();
            while shard.waiting() > 0 && !common.is_stopping() {
                expand(shard, task, common, &mut letters, account);
                if let Some(reason) = watch(&common.progress(depth)) {
                    common.stop(End::Stopped(Stop::Watcher(reason)));
                }
            }
            letters.iter_mut().enumerate().for_each(|(to, letter)| common.send(to, letter));
        }
        for (number, shard) in shards.iter_mut().enumerate() {
            common.letters(number, false).iter().for_each(|letter| shard.receive(letter));
        }
    }

    /// Expands all states of a level, each shard on a thread of its own.
    fn level_together(&mut self, accounts: &mut [Progress], watch: Watch<'_>) {
        let Self { task, shards, common } = self;
        let (task, common) = (&*task, &*common);
        common.busy.store(shards.len(), Ordering::Release);
        let depth = shards[0].levels.len() - 1;
        let mut work = shards.iter_mut().zip(accounts).enumerate();
        let Some((_, (mine, account))) = work.next() else { return };
        thread::scope(|scope| {
            for (number, (shard, account)) in work {
                scope.spawn(move || level_of(number, shard, account, task, common, &mut || {}));
            }
            level_of(0, mine, account, task, common, &mut || {
                if let Some(reason) = watch(&common.progress(depth)) {
                    common.stop(End::Stopped(Stop::Watcher(reason)));
                }
            });
        });
    }
}

/// Expands a shard's states of a level, and inserts states received from other shards, until all shards are done.
fn level_of(
    number: usize,
    shard: &mut Shard,
    account: &mut Progress,
    task: &Task<'_>,
    common: &Common,
    between: &mut dyn FnMut(),
) {
    let mut letters: Vec<Letter> = (0..task.shards).map(|_| Letter::default()).collect();
    let mut busy = true;
    loop {
        if busy && shard.waiting() > 0 && !common.is_stopping() {
            expand(shard, task, common, &mut letters, account);
        } else if busy {
            letters.iter_mut().enumerate().for_each(|(to, letter)| common.send(to, letter));
            common.rest();
            busy = false;
        }
        // A thread that sees that no shard is busy also sees all messages: they were sent before.
        let all_done = common.busy.load(Ordering::Acquire) == 0;
        let arrived = common.letters(number, !busy);
        arrived.iter().for_each(|letter| shard.receive(letter));
        if all_done {
            return;
        }
        between();
    }
}

/// Expands a block of states and sends full messages.
fn expand(shard: &mut Shard, task: &Task<'_>, common: &Common, letters: &mut [Letter], account: &mut Progress) {
    match shard.expand(BLOCK, task, letters) {
        Some(Halt::Overflow(words)) => common.stop(End::Overflow(words)),
        Some(Halt::Found(words)) => common.stop(End::Found(words)),
        None => {}
    }
    for (to, letter) in letters.iter_mut().enumerate() {
        if letter.words.len() >= LETTER {
            common.send(to, letter);
        }
    }
    common.account(shard, account);
}
