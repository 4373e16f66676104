//! `petril explain`: explains a code, with a program that is rejected and one that is accepted.
//!
//! The pages are `docs/codes/*.md`; `tests/diagnostics.rs` checks them against the diagnostics.

use petril::diagnostic::{Code, nearest};
use petril::printable;

use super::args::Explain;
use super::console::Console;
use super::{Failure, Outcome};

macro_rules! pages {
    ($($id:literal)+) => {
        &[$(($id, include_str!(concat!("../../docs/codes/", $id, ".md")))),+]
    };
}

/// Page of each code.
const PAGES: &[(&str, &str)] = pages! {
    "E0101" "E0102" "E0103" "E0104" "E0105" "E0106" "E0107" "E0108" "E0109" "E0110" "E0111" "E0112" "E0113"
    "E0114"
    "E0201" "E0202" "E0203" "E0204" "E0205" "W0206" "W0207" "E0208" "E0209" "E0210" "E0211" "E0212" "E0213"
    "E0214" "E0215" "E0216" "E0217" "W0218" "E0219" "E0220" "W0221" "W0222" "W0223" "W0224" "E0225" "E0226"
    "W0227"
    "E0302" "E0303" "E0304" "E0305" "E0306" "E0307" "E0308" "E0309" "E0310" "W0311" "W0312" "E0313" "E0314"
    "E0315" "E0316" "E0317" "E0318" "E0319" "E0320" "E0321" "E0322" "E0323" "E0324" "E0325" "E0326" "W0327"
    "W0328" "E0329" "E0330" "W0331"
    "E0401" "E0402" "E0403" "E0404" "E0405" "E0406" "E0407" "E0408" "E0409" "E0410" "W0411" "E0412" "W0413" "W0414"
    "E0501" "E0502" "E0503" "E0504" "E0505" "E0506" "E0507" "E0508" "E0510" "E0511" "W0512" "W0514"
    "E0601"
    "E0701" "E0702" "E0703" "E0704" "E0705" "E0706" "E0707" "E0708" "E0709"
    "E0801" "E0802" "E0803" "E0804" "E0805"
    "E0901" "E0902" "E0903" "E0904" "E0905" "E0906" "E0907" "E0908" "E0911" "E0912" "E0913"
    "W0920" "W0921" "W0922" "W0923" "W0924" "W0925" "W0926" "W0927" "W0928" "W0929" "W0930" "W0931" "W0932"
};

pub fn run(arguments: &Explain, console: &Console) -> Outcome {
    let Some(word) = &arguments.code else {
        let lines = Code::ALL.iter().map(|code| format!("{code}  {}\n", code.summary()));
        return console.print(&lines.collect::<String>());
    };
    match PAGES.iter().find(|(id, _)| id.eq_ignore_ascii_case(word)) {
        Some((_, page)) => console.print(page),
        None => {
            let hint = match nearest(word, PAGES.iter().map(|&(id, _)| id)) {
                Some(id) => format!("; did you mean {id}?"),
                None => String::new(),
            };
            Err(Failure::Message(format!(
                "there is no code `{}`{hint}\n  `petril explain` without a code lists them all",
                printable::line(word)
            )))
        }
    }
}
