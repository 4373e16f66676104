//! Configurations (B.1.7): tasks and the programs they run.

use super::{Constant, Name};

/// `CONFIGURATION … END_CONFIGURATION`, all its resources taken together.
#[derive(Clone, Debug)]
pub struct Configuration {
    /// Name of the configuration.
    pub name: Name,
    /// Tasks of all resources.
    pub tasks: Vec<Task>,
    /// Program instances, with or without a task.
    pub programs: Vec<ProgramInstance>,
}

/// `TASK name (INTERVAL := T#20ms, PRIORITY := 1);`
#[derive(Clone, Debug)]
pub struct Task {
    /// Name of the task.
    pub name: Name,
    /// Literal after `INTERVAL :=`.
    pub interval: Option<Constant>,
}

/// `PROGRAM name WITH task : type;`
#[derive(Clone, Debug)]
pub struct ProgramInstance {
    /// Name of the instance.
    pub name: Name,
    /// Task that runs the instance.
    pub task: Option<Name>,
    /// Program type.
    pub program: Name,
}
