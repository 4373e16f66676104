//! Plants that are none.

use super::{MANY, refused, run};

const PROGRAM: &[u8] =
    b"PROGRAM p\nVAR_INPUT a, b : BOOL; END_VAR\nVAR m : BOOL; END_VAR\nVAR_OUTPUT q : BOOL; END_VAR\nLD a\nST q\nEND_PROGRAM\n";

/// The net, as a plant of the program, is refused at this line and column, with these words.
fn is_refused(name: &str, text: impl AsRef<[u8]>, place: &str, words: &[&str]) {
    let place = if place.is_empty() { String::new() } else { format!("{name}:{place}") };
    let run = run(&[("p.il", PROGRAM), (name, text.as_ref())], &["check", "p.il", "--plant", name]);
    refused(&run, &place, words);
}

fn net_is_refused(text: &str, place: &str, words: &[&str]) {
    is_refused("n.net", text, place, words);
}

fn pnml(page: &str) -> String {
    let (pnml, net) =
        ("http://www.pnml.org/version-2009/grammar/pnml", "http://www.pnml.org/version-2009/grammar/ptnet");
    format!("<pnml xmlns='{pnml}'><net id='n' type='{net}'><page id='page'>\n{page}</page></net></pnml>")
}

#[test]
fn inputs_must_be_known_and_driven_well() {
    net_is_refused("pl {a=1,x=0} (1)\n", "1:4", &["E0404", "no input or output `x`"]);
    net_is_refused("pl {m=1} (1)\n", "1:4", &["E0405", "neither an input nor an output"]);
    net_is_refused("pl {a=maybe} (1)\n", "1:4", &["E0405", "a=maybe"]);
    net_is_refused("pl {a=1,q=0} (1)\n", "1:4", &["E0405", "inputs and outputs at once"]);
    net_is_refused("pl {a=1}\ntr t {a=1} -> {a=0}\n", "1:4", &["E0407", "`a` has no value", "at the beginning"]);
    net_is_refused("pl {a=1} (1)\ntr t {a=1} -> x\ntr u x -> {a=0}\n", "1:4", &["E0407", "after `n.t`"]);
    net_is_refused("pl {a=1} (1)\npl x (1)\ntr t x {a=1}?1 -> {a=0}\n", "3:19", &["E0407", "two marked places"]);
    net_is_refused("pl {a=1} (1)\npl {a=0} (1)\n", "2:4", &["E0407", "two devices"]);
}

#[test]
fn plants_must_be_safe_and_leave_the_program_alone() {
    net_is_refused("pl {a=1} (1)\ntr t {a=1}?1 -> x\n", "2:17", &["E0406", "`n.x`", "second token"]);
    net_is_refused("pl {a=1} (1)\ntr t -> {a=1}\n", "1:4", &["E0406"]);
    net_is_refused("pl {a=1} (1)\ntr t {a=1} -> {a=0} {q=1}\n", "2:4", &["E0408", "changes an output"]);
    net_is_refused("pl {a=1} (1)\ntr t {q=1} {a=1} -> {a=0}\n", "2:4", &["E0408"]);
    net_is_refused("pl {q=1} (1)\n", "1:4", &["E0405", "marked"]);
    net_is_refused("", "1:1", &["E0405", "gives no input a value"]);
    net_is_refused("pl a_1 (1)\ntr t a_1 -> a_0\n", "1:4", &["E0405", "like `S1=1,O1=0`"]);
}

#[test]
fn devices_that_are_too_large_are_refused() {
    for n in [20, 300, 5000] {
        let free: String =
            (0..n).map(|i| format!("tr t{i} p{i} c?1 -> q{i}\ntr u{i} q{i} c?1 -> p{i}\npl p{i} (1)\n")).collect();
        net_is_refused(
            &format!("pl {{a=1}} (1)\npl c (1)\ntr t {{a=1}} c?1 -> {{a=0}}\n{free}"),
            "1:4",
            &["E0410", "too many"],
        );
    }
    // A cycle of a hundred thousand places has as many markings.
    let cycle: String = (0..MANY).map(|i| format!("tr t{i} p{i} -> p{}\n", (i + 1) % MANY)).collect();
    net_is_refused(&format!("pl p0 (1)\npl {{a=1}} (1)\ntr t p0?1 {{a=1}} -> {{a=0}}\n{cycle}"), "", &["E0410"]);
}

#[test]
fn nets_that_cannot_be_read_are_refused() {
    net_is_refused("net n\nfoo\n", "2:1", &["E0401", "expected `net`, `pl` or `tr`"]);
    net_is_refused("net n\npl p (2)\n", "2:6", &["E0402", "2 tokens"]);
    net_is_refused("tr t p*2 -> q\n", "1:6", &["E0402", "weight 2"]);
    net_is_refused("pl {a=1\n", "1:4", &["E0401", "ends with `}`"]);
    net_is_refused("pl p\npl p\n", "2:4", &["E0403", "defined twice"]);
    net_is_refused(&"tr t p\n".repeat(MANY), "1:7", &["E0401", "more in n.net"]);
    net_is_refused(&format!("tr t {}-> q\n", "p ".repeat(MANY)), "1:8", &["E0402", "more in n.net"]);
    is_refused("n.net", b"net n\n\0", "2:1", &["E0101"]);
    is_refused("n.net", pnml(""), "1:1", &["E0401"]);
}

#[test]
fn pnml_that_cannot_be_read_is_refused() {
    let refuse = |text: &str, place: &str, words: &[&str]| is_refused("n.pnml", text, place, words);
    refuse("", "1:1", &["E0401", "no well-formed XML"]);
    refuse("net n\n", "1:1", &["E0401", "no well-formed XML"]);
    refuse("<pnml>\n<net", "2:5", &["E0401", "no well-formed XML"]);
    refuse("<html/>", "1:1", &["E0401", "no PNML"]);
    refuse("<pnml/>", "1:1", &["E0401", "no net"]);
    refuse("<pnml><net id='a'/></pnml>", "1:7", &["E0401", "no type", "ptnet"]);
    refuse(
        &pnml("<place id='p'>\n<initialMarking><text>many</text></initialMarking></place>"),
        "3:23",
        &["E0401", "many"],
    );
    refuse(&pnml("<arc id='a' source='x' target='y'/>"), "2:21", &["E0403", "`x`"]);
    refuse(&pnml("<place/>"), "2:1", &["E0401", "no attribute `id`"]);
    refuse(&pnml(&"<place id='p'/>\n".repeat(MANY)), "3:12", &["E0403", "given twice", "more in n.pnml"]);
    refuse(&"<pnml>".repeat(MANY), "", &["E0401", "never closed"]);
    refuse(&pnml(&format!("{}{}", "<page>".repeat(MANY), "</page>".repeat(MANY))), "", &["E0405"]);
    is_refused("n.pnml", b"<pnml>\0</pnml>", "1:7", &["E0101"]);
}

/// Ten entities that are ten of the one before each would be ten gigabytes.
#[test]
fn entities_are_not_expanded() {
    let ten = |i: usize| format!("<!ENTITY e{i} \"{}\">\n", format!("&e{};", i - 1).repeat(10));
    let entities: String = (1..=10).map(ten).collect();
    let text = format!("<?xml version='1.0'?>\n<!DOCTYPE pnml [\n<!ENTITY e0 'x'>\n{entities}]>\n<pnml>&e10;</pnml>");
    is_refused("n.pnml", text, "2:1", &["E0401", "document type"]);
    let outside = "<!DOCTYPE pnml [<!ENTITY e SYSTEM 'file:///etc/hostname'>]><pnml>&e;</pnml>";
    is_refused("n.pnml", outside, "1:1", &["document type"]);
    is_refused("n.pnml", "<pnml>&e;</pnml>", "1:7", &["unknown entity"]);
}

#[test]
fn other_names_are_refused() {
    is_refused("n.txt", "net n\n", "", &["`n.txt`", ".net or .pnml"]);
    is_refused("n", "net n\n", "", &[".net or .pnml"]);
    let twice = ["check", "p.il", "--plant", "n.net", "--plant", "n.net"];
    refused(
        &run(&[("p.il", PROGRAM), ("n.net", b"pl {a=1} (1)\n")], &twice),
        "n.net:1:4",
        &["E0409", "two plants named `n`"],
    );
}
