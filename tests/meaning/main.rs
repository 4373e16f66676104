//! The meanings of programs: interpreter, net and the tests' own interpreter agree.

mod devices;
mod net_agrees_with_interpreter;
mod scans_agree;
mod wide;
mod wide_nets_agree_with_interpreter;
mod wide_nets_are_safe;
mod wide_programs_agree;
