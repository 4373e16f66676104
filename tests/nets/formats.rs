//! Nets in all formats: `docs/nets.md` shows one in each, and what is written is read by readers of its own.
//!
//! To write what is written now into the document: `PETRIL_BLESS=1 cargo test --test nets formats`. Then read it.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

use petril::exchange::pnml::{self, Extras};
use petril::exchange::{andl, ina, lola, tina, unescaped};
use petril::net::{Builder, Marking, Net, Units};
use petril::source::Source;
use petril::translate::System;
use proptest::prelude::*;
use support::process::petril;
use support::systems::{CYLINDER, EVERY_INSTRUCTION, HANDS, TWO_HAND_SWITCH, system};
use tempfile::TempDir;

#[test]
fn the_guide_shows_what_is_written() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/nets.md");
    let text = fs::read_to_string(&path).unwrap();
    let folder = TempDir::new().unwrap();
    let mut now = String::new();
    let mut lines = text.lines();
    let mut is_ours = false;
    while let Some(line) = lines.next() {
        now += &format!("{line}\n");
        is_ours = if line.starts_with("## ") { line == "## Formats" } else { is_ours };
        let Some(info) = line.strip_prefix("```") else { continue };
        let block: String = lines.by_ref().take_while(|line| *line != "```").map(|line| format!("{line}\n")).collect();
        let file = info.split_whitespace().nth(1).filter(|_| is_ours);
        now += &match file {
            Some("buffer.net") => {
                fs::write(folder.path().join("buffer.net"), &block).unwrap();
                block
            }
            Some(name) => {
                let run = petril(folder.path(), &["net", "convert", "buffer.net", "-o", name]);
                assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{name}");
                assert_eq!(run.stdout, format!("{name}: 3 places, 2 transitions\n"));
                fs::read_to_string(folder.path().join(name)).unwrap()
            }
            None => block,
        };
        now += "```\n";
    }
    if std::env::var_os("PETRIL_BLESS").is_some() {
        fs::write(path, now).unwrap();
    } else {
        assert!(now == text, "docs/nets.md is stale; now it would be\n{now}");
    }
}

/// A net as a format has it: places with tokens; transitions with what they take and put.
type Plain = (Vec<(String, u64)>, Vec<(String, Arcs, Arcs)>);
type Arcs = BTreeMap<String, u64>;

fn plain(net: &Net) -> Plain {
    let named = |arcs: &mut dyn Iterator<Item = (petril::net::PlaceId, u64)>| -> Arcs {
        arcs.map(|(place, weight)| (net.place(place).name.to_owned(), weight)).collect()
    };
    let places = net.places().map(|place| (place.name.to_owned(), place.tokens)).collect();
    let transitions = net
        .transition_ids()
        .map(|id| (net.transition(id).name.to_owned(), named(&mut net.pre(id)), named(&mut net.post(id))))
        .collect();
    (places, transitions)
}

/// A reader of LoLA's format that knows what Petril writes.
fn from_lola(text: &str) -> Plain {
    let name = |word: &str| unescaped(word.trim()).unwrap();
    let list = |text: &str| -> Arcs {
        let items = text.split(',').filter(|item| !item.trim().is_empty());
        items.map(|item| item.split_once(": ").unwrap()).map(|(n, k)| (name(n), k.trim().parse().unwrap())).collect()
    };
    let mut parts = text.split(';');
    let places = parts.next().unwrap().trim().strip_prefix("PLACE ").unwrap();
    let marking = list(parts.next().unwrap().trim().strip_prefix("MARKING").unwrap());
    let places = places.split(',').map(name).map(|name| (name.clone(), marking.get(&name).copied().unwrap_or(0)));
    let places = places.collect();
    let parts: Vec<&str> = parts.map(str::trim).filter(|part| !part.is_empty()).collect();
    let transitions = parts.chunks(2).map(|pair| {
        let (head, take) = pair[0].strip_prefix("TRANSITION ").unwrap().split_once("\nCONSUME").unwrap();
        (name(head), list(take), list(pair[1].strip_prefix("PRODUCE").unwrap()))
    });
    (places, transitions.collect())
}

/// A reader of ANDL that knows what Petril writes.
fn from_andl(text: &str) -> Plain {
    let name = |word: &str| unescaped(word.trim()).unwrap();
    let (_, text) = text.split_once("discrete:\n").unwrap();
    let (places, transitions) = text.strip_suffix("}\n").unwrap().split_once("transitions:\n").unwrap();
    let places = places.lines().map(|line| {
        let (place, tokens) = line.strip_suffix(';').unwrap().split_once(" = ").unwrap();
        (name(place), tokens.parse().unwrap())
    });
    let transitions = transitions.lines().map(|line| {
        let (head, arcs) = line.strip_suffix(" ;").unwrap().split_once(" : :").unwrap();
        let mut lists = (Arcs::new(), Arcs::new());
        for arc in arcs.split('&').map(str::trim).filter(|arc| !arc.is_empty()) {
            let words: Vec<&str> = arc.trim_matches(['[', ']']).split(' ').collect();
            let [place, sign, weight] = words[..] else { panic!("{arc}") };
            let list = if sign == "-" { &mut lists.0 } else { &mut lists.1 };
            assert_eq!(list.insert(name(place), weight.parse().unwrap()), None);
        }
        (name(head), lists.0, lists.1)
    });
    (places.collect(), transitions.collect())
}

/// A reader of INA's format that knows what Petril writes, with the names in full.
fn from_ina(text: &str) -> Plain {
    let parts: Vec<&str> = text.splitn(4, "@\n").collect();
    let [structure, places, transitions, full] = parts[..] else { panic!("{text}") };
    let names = |part: &str, kind: &str| -> Vec<String> {
        let short: Vec<&str> = part.lines().skip(1).map(|line| &line[10..26]).collect();
        let trimmed: Vec<&str> = short.iter().map(|name| name.trim_end()).collect();
        assert!(trimmed.iter().all(|name| !name.is_empty() && !name.contains([' ', ':', ',', '@'])), "{trimmed:?}");
        let unique: std::collections::BTreeSet<_> = trimmed.iter().collect();
        assert_eq!(unique.len(), trimmed.len(), "{trimmed:?}");
        let mut names: Vec<String> = trimmed.into_iter().map(str::to_owned).collect();
        for line in full.lines().filter_map(|line| line.strip_prefix(kind)) {
            let (number, name) = line.split_once(": ").unwrap();
            names[number.trim().parse::<usize>().unwrap()] = unescaped(name).unwrap();
        }
        names
    };
    let (places, transitions) = (names(places, "place"), names(transitions, "trans"));
    let mut net: Plain = (Vec::new(), transitions.into_iter().map(|name| (name, Arcs::new(), Arcs::new())).collect());
    for (line, place) in structure.lines().skip(1).zip(places) {
        let (_, rest) = line.trim_start().split_once(' ').unwrap();
        let (tokens, arcs) = rest.split_once(' ').unwrap_or((rest, ""));
        let (pre, post) = arcs.split_once(',').unwrap_or((arcs, ""));
        for (list, is_pre) in [(pre, true), (post, false)] {
            for arc in list.split_whitespace() {
                let (transition, weight) = arc.split_once(':').unwrap_or((arc, "1"));
                let transition = &mut net.1[transition.parse::<usize>().unwrap()];
                let list = if is_pre { &mut transition.2 } else { &mut transition.1 };
                assert_eq!(list.insert(place.clone(), weight.parse().unwrap()), None);
            }
        }
        net.0.push((place, tokens.parse().unwrap()));
    }
    net
}

/// Any characters a format could stumble over, and the words it knows.
const AWKWARD: &str =
    "([a-c'_xX0-9 {}\\\\#<>&\"äβ→😀:*?!(),;@/\\[\\]\n\r\t]{0,6}|_x41_|PLACE|AG|min|net|pl|a{15,18}|_x_)";
/// The same without what XML cannot keep: outer blanks and control characters, and names of no length.
const AWKWARD_IN_XML: &str = "[a-c'_0-9{}\\\\#<>&\"äβ→😀:*?!()\\[\\]]([a-c <>&]{0,4}[a-c}\"])?";

/// Small nets with weights and tokens; names are unique among places and among transitions.
fn weighted(name: &'static str) -> impl Strategy<Value = Net> {
    let names =
        || prop::collection::btree_set(name, 1..6).prop_map(|set| set.into_iter().collect::<Vec<_>>()).prop_shuffle();
    let list = || prop::collection::vec((0..6_usize, prop_oneof![3 => Just(1), 1 => 1..5_u64]), 0..4);
    let tokens = prop::collection::vec(prop_oneof![Just(0), Just(1), 2..2000_u64], 6);
    (names(), tokens, names(), prop::collection::vec([list(), list(), list()], 6)).prop_map(
        |(places, tokens, transitions, lists)| {
            let mut builder = Builder::new("weighted");
            let ids: Vec<_> =
                places.iter().zip(tokens).map(|(name, tokens)| builder.place_with(name, tokens)).collect();
            for (name, lists) in transitions.iter().zip(lists) {
                // Positions beyond the last place mean no arc.
                let [take, put, test] =
                    lists.map(|list| list.into_iter().filter_map(|(p, n)| Some((*ids.get(p)?, n))).collect::<Vec<_>>());
                builder.weighted(name, &take, &put, &test);
            }
            builder.build()
        },
    )
}

proptest! {
    #[test]
    fn weights_go_through_every_format(net in weighted(AWKWARD)) {
        let text = tina::write(&net);
        let read = tina::read(&Source::new("n.net", text.as_str())).map_err(|e| TestCaseError::fail(format!("{text}\n{e:?}")))?;
        prop_assert_eq!(&read.net, &net);
        let meant = plain(&net);
        prop_assert_eq!(from_lola(&lola::write(&net, false)), meant.clone());
        prop_assert_eq!(from_andl(&andl::write(&net)), meant.clone());
        prop_assert_eq!(from_ina(&ina::write(&net)), meant);
    }

    #[test]
    fn weights_go_through_pnml(net in weighted(AWKWARD_IN_XML)) {
        let text = pnml::write(&net, Extras::default());
        let read = pnml::read(&Source::new("n.pnml", text.as_str())).map_err(|e| TestCaseError::fail(format!("{text}\n{e:?}")))?;
        prop_assert_eq!(plain(&read.net), plain(&net));
        // Once more, with the ids of the first.
        let again = pnml::write(&read.net, Extras { ids: read.ids.as_ref(), ..Extras::default() });
        prop_assert_eq!(again, text);
    }

    #[test]
    fn names_of_andl_and_lola_are_names(net in weighted(AWKWARD)) {
        let is_name = |name: &str| name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') && !name.starts_with(|c: char| c.is_ascii_digit());
        let mut seen = std::collections::BTreeSet::new();
        for line in andl::write(&net).lines().filter_map(|line| line.strip_prefix("  ")) {
            let name = line.split(' ').next().unwrap().to_owned();
            prop_assert!(is_name(&name) && !["AG", "min", "MIN"].contains(&name.as_str()), "{}", name);
            prop_assert!(seen.insert(name), "{}", line);
        }
        prop_assert!(lola::write(&net, false).is_ascii());
    }
}

/// One place at most of each unit is marked, and none of those it is in, in every reachable marking.
fn assert_safe(net: &Net, units: &Units, limit: usize) {
    let mut unit_of = vec![usize::MAX; net.places().len()];
    for (position, unit) in units.units.iter().enumerate() {
        for place in &unit.places {
            assert_eq!(std::mem::replace(&mut unit_of[place.index()], position), usize::MAX, "in two units");
        }
    }
    assert!(!unit_of.contains(&usize::MAX), "a place in no unit");
    let root = &units.units[units.root];
    assert!(root.places.is_empty() && root.subunits.len() == units.units.len() - 1, "units side by side");
    let check = |marking: &Marking| {
        let mut marked = vec![false; units.units.len()];
        for place in net.place_ids().filter(|&place| marking.is_marked(place)) {
            let unit = unit_of[place.index()];
            assert!(!std::mem::replace(&mut marked[unit], true), "two places of unit {unit} are marked");
        }
    };
    let mut seen = std::collections::BTreeSet::from([net.initial_marking()]);
    let mut queue = vec![net.initial_marking()];
    while let Some(marking) = queue.pop() {
        check(&marking);
        for transition in net.enabled(&marking) {
            let mut next = marking.clone();
            net.fire(&mut next, transition).unwrap();
            if seen.len() < limit && seen.insert(next.clone()) {
                queue.push(next);
            }
        }
    }
}

/// A plant of two devices, one of which has two marked places at once.
const TWO_DEVICES: &str = "net devices\npl {a=1} (1)\npl {a=0}\npl warm (1)\npl cold\ntr move {a=1} warm -> {a=0} cold
tr back {a=0} -> {a=1}\ntr heat cold {q=1}?1 -> warm\n";

fn systems() -> [System; 3] {
    let program = "PROGRAM p VAR_INPUT a, b : BOOL; END_VAR VAR n : USINT; END_VAR VAR_OUTPUT q : BOOL; END_VAR
        LD a\nAND b\nST q\nLD n\nADD 100\nST n\nEND_PROGRAM";
    [system(TWO_HAND_SWITCH, &[HANDS]), system(EVERY_INSTRUCTION, &[CYLINDER]), system(program, &[TWO_DEVICES])]
}

#[test]
fn the_units_of_a_program_are_safe() {
    for system in systems() {
        let units = system.units();
        assert!(units.safe);
        assert_safe(&system.net, &units, 20_000);
    }
    let [switch, _, devices] = systems();
    // Control, S1, S2, O1, O2 and so on with two places each, and the two hands, each with what lets it move.
    let sizes = |system: &System| {
        let units = system.units();
        let mut sizes: Vec<usize> = units.units.iter().map(|unit| unit.places.len()).collect();
        sizes.sort_unstable();
        sizes
    };
    assert_eq!(sizes(&switch).iter().sum::<usize>(), switch.net.places().len());
    // Two places of `devices` are marked at once: the device has two units.
    assert_eq!(sizes(&devices).iter().sum::<usize>(), devices.net.places().len());
}

#[test]
fn units_go_through_pnml_and_fit_its_grammar() {
    let folder = TempDir::new().unwrap();
    for (i, system) in systems().into_iter().enumerate() {
        let units = system.units();
        let text = pnml::write(&system.net, Extras { units: Some(&units), ..Extras::default() });
        let read = pnml::read(&Source::new("n.pnml", text.as_str())).unwrap();
        assert_eq!(read.warnings, []);
        assert_eq!(read.units.as_ref(), Some(&units));
        let again = Extras { units: read.units.as_ref(), ids: read.ids.as_ref(), ..Extras::default() };
        assert_eq!(pnml::write(&read.net, again), text);
        fs::write(folder.path().join(format!("{i}.pnml")), text).unwrap();
    }
    let Some(data) = std::env::var_os("PETRIL_DATA") else { return println!("PETRIL_DATA is not set: no grammar") };
    let grammar = Path::new(&data).join("pnml-grammar/ptnet.pntd");
    for i in 0..3 {
        let mut command = Command::new("xmllint");
        command.args(["--noout", "--relaxng"]).arg(&grammar).arg(format!("{i}.pnml")).current_dir(folder.path());
        let Ok(output) = command.output() else { return println!("there is no xmllint") };
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
}

#[test]
fn ids_that_not_every_tool_would_take_are_replaced() {
    let net = "http://www.pnml.org/version-2009/grammar/ptnet";
    let text = format!(
        "<pnml><net id='n' type='{net}'><page id='g'><place id='1'/><place id='p0'/><place id='net'/>
         <transition id='T-1.x'/><transition id='a0'/><transition id='é'/>
         <arc id='x' source='1' target='T-1.x'/></page></net></pnml>"
    );
    let read = pnml::read(&Source::new("n.pnml", text)).unwrap();
    let written = pnml::write(&read.net, Extras { ids: read.ids.as_ref(), ..Extras::default() });
    let again = pnml::read(&Source::new("n.pnml", written.as_str())).unwrap();
    let (places, transitions) = again.ids.unwrap();
    assert_eq!(places, ["p0_", "p0", "net"]);
    assert_eq!(transitions, ["T-1.x", "a0", "t2"]);
    assert!(written.contains("<net id=\"net_\"") && written.contains("<arc id=\"a0_\""), "{written}");
    assert_eq!(again.net.places().map(|place| place.name).collect::<Vec<_>>(), ["1", "p0", "net"]);
}
