//! `petril translate`: the net of a program and its plant, as a file.

use std::ffi::OsStr;

use petril::draw;
use petril::exchange::{dot, pnml, tina};
use petril::translate::Part;

use super::args::Translate;
use super::console::Console;
use super::{Failure, Outcome, SUCCESS, input, output};

pub fn run(arguments: &Translate, console: &Console) -> Outcome {
    Ok(SUCCESS)
}
