//! Projects: several programs, each with its plants and requirements, checked by one command.

mod assumed;
mod file;
mod forms;
mod given;
mod keys;
mod programs;
mod run;
mod summary;
mod workers;

pub use given::given;
pub use run::run;
