//! Texts to programs: what is read, what is reported, and programs that others wrote.

mod coverage;
mod diagnostics;
mod golden;
mod malformed;
mod plcopen;
