//! Markdown documents that show input files, commands and what these print, and are held to it.
//!
//! A fenced block whose info string has a second word, like `il press.il`, is a file of that name. A block `console` holds
//! commands after `$ `, each followed by the exit code (`? 2`, if it is not 0) and by what the command prints. Files live as
//! long as their section: every heading begins with an empty folder.
//!
//! More words in the info string of a file: `escaped` (`\0` stands for a NUL byte, `\xFC` for any other), `length=N` (blanks
//! follow until the file has N bytes).

use std::fs;
use std::path::Path;

use tempfile::TempDir;

use super::process::{Run, petril};

/// The document as it would have to be: its own text with what the commands print now.
pub fn replay(text: &str) -> String {
    replay_again(text).0
}

/// The same, and what the last command does when it is run again with the files as they are at the end.
pub fn replay_again(text: &str) -> (String, Option<Run>) {
    let mut last = None;
    let mut out = String::new();
    let mut folder = TempDir::new().expect("there is room for files");
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        out += &format!("{line}\n");
        if line.starts_with('#') {
            folder = TempDir::new().expect("there is room for files");
        }
        let Some(info) = line.strip_prefix("```") else { continue };
        let block: Vec<&str> = lines.by_ref().take_while(|line| *line != "```").collect();
        match info.split_whitespace().collect::<Vec<_>>().as_slice() {
            ["console"] => {
                let commands: Vec<&str> = block.iter().copied().filter(|line| line.starts_with("$ ")).collect();
                let answers: Vec<String> = commands.iter().map(|line| answer(line, folder.path())).collect();
                last = commands.last().copied();
                out += &answers.join("\n");
            }
            words => {
                if let [_, name, options @ ..] = words {
                    let path = folder.path().join(name);
                    fs::create_dir_all(path.parent().expect("a file is in a folder")).expect("a folder can be made");
                    fs::write(path, content(&block, options)).expect("a file can be written");
                }
                block.iter().for_each(|line| out += &format!("{line}\n"));
            }
        }
        out += "```\n";
    }
    (out, last.map(|line| execute(line, folder.path())))
}

/// A command with its exit code and output.
fn answer(line: &str, folder: &Path) -> String {
    let run = execute(line, folder);
    let code = if run.code == 0 { String::new() } else { format!("? {}\n", run.code) };
    // Messages come before results.
    format!("{line}\n{code}{}{}", run.stderr, run.stdout).trim_end().to_owned() + "\n"
}

fn execute(line: &str, folder: &Path) -> Run {
    let words: Vec<String> = words(line);
    assert_eq!(words[..2], ["$", "petril"], "{line}");
    petril(folder, &words[2..])
}

/// The words of a command; quotes keep blanks.
fn words(line: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut quoted = false;
    for c in line.chars() {
        match c {
            '\'' => quoted = !quoted,
            ' ' if !quoted => words.push(String::new()),
            _ => words.last_mut().expect("there is a word").push(c),
        }
    }
    words
}

/// The bytes of a file.
fn content(block: &[&str], options: &[&str]) -> Vec<u8> {
    let text: String = block.iter().map(|line| format!("{line}\n")).collect();
    let mut bytes = if options.contains(&"escaped") { unescaped(&text) } else { text.into_bytes() };
    if let Some(length) = options.iter().find_map(|option| option.strip_prefix("length=")) {
        bytes.resize(length.parse().expect("a length is a number"), b' ');
    }
    bytes
}

fn unescaped(text: &str) -> Vec<u8> {
    let mut pieces = text.split('\\');
    let mut bytes = pieces.next().unwrap_or_default().as_bytes().to_vec();
    for piece in pieces {
        let (byte, rest) = match piece.strip_prefix('x') {
            Some(hex) => (u8::from_str_radix(&hex[..2], 16).expect("two digits follow"), &hex[2..]),
            None => (0, &piece[1..]),
        };
        bytes.push(byte);
        bytes.extend(rest.as_bytes());
    }
    bytes
}
