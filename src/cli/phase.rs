//! The phase of the work: of the process, and of each program of a project.

use std::cell::RefCell;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A phase of the work.
#[derive(Clone, Copy, Debug)]
pub struct Phase {
    pub name: &'static str,
    /// Whether the work asks if it is to stop, and then reports what it has found.
    pub is_asking: bool,
}

impl Phase {
    const FIRST: Self = Self { name: "starting", is_asking: false };
}

/// A phase that others look at while it goes on.
#[derive(Clone, Debug)]
pub struct Shown(Arc<Mutex<Phase>>);

impl Shown {
    /// The phase now.
    pub fn get(&self) -> Phase {
        *lock(&self.0)
    }
}

static OF_PROCESS: Mutex<Phase> = Mutex::new(Phase::FIRST);

thread_local! {
    static OF_THREAD: RefCell<Option<Shown>> = const { RefCell::new(None) };
}

/// Begins a phase that does not ask whether it is to stop: it is ended from outside as soon as a limit is reached.
pub fn begin(name: &'static str) {
    set(Phase { name, is_asking: false });
}

/// Begins a phase that asks whether it is to stop, and gets the time to report what it has found.
pub fn begin_asking(name: &'static str) {
    set(Phase { name, is_asking: true });
}

/// The phase of the process.
pub fn of_process() -> Phase {
    *lock(&OF_PROCESS)
}

/// Sets the phases of this thread apart from those of the process, and shows them.
pub fn set_apart() -> Shown {
    let shown = Shown(Arc::new(Mutex::new(Phase::FIRST)));
    OF_THREAD.set(Some(shown.clone()));
    shown
}

fn set(phase: Phase) {
    OF_THREAD.with_borrow(|own| match own {
        Some(Shown(own)) => *lock(own) = phase,
        None => *lock(&OF_PROCESS) = phase,
    });
}

fn lock(phase: &Mutex<Phase>) -> MutexGuard<'_, Phase> {
    phase.lock().unwrap_or_else(PoisonError::into_inner)
}
