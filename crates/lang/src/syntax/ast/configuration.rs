//! Configurations (B.1.7): what runs how often.

use super::{Constant, Name};

/// `CONFIGURATION … END_CONFIGURATION` with its resources taken together.
#[derive(Clone, Debug)]
pub struct Configuration {
    /// Its name.
    pub name: Name,
    /// Its tasks.
    pub tasks: Vec<Task>,
    /// What its tasks run.
    pub programs: Vec<ProgramInstance>,
}

/// `TASK name (INTERVAL := T#20ms, PRIORITY := 1);`
#[derive(Clone, Debug)]
pub struct Task {
    /// Its name.
    pub name: Name,
    /// The literal behind `INTERVAL :=`.
    pub interval: Option<Constant>,
}

/// `PROGRAM name WITH task : type;`
#[derive(Clone, Debug)]
pub struct ProgramInstance {
    /// Its name.
    pub name: Name,
    /// The task that runs it.
    pub task: Option<Name>,
    /// The program it is an instance of.
    pub program: Name,
}
