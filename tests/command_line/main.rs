//! Sessions at the command line, projects, and limits.

mod cli;
mod limits;
mod projects;
