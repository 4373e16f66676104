//! What is written is what was meant: round trips, and counts that others have computed.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::collections::{BTreeSet, VecDeque};
use std::process::Command;

use petril::draw::positions;
use petril::exchange::pnml::{self, Extras};
use petril::exchange::{notes, tina};
use petril::flat::{Function, Instruction, Operand, Target};
use petril::net::{Arcs, Builder, Net};
use petril::semantics::{Role, Type, VarId};
use petril::source::Source;
use petril::translate::{Part, Plant, System};
use proptest::prelude::*;
use support::systems::{CYLINDER, EVERY_INSTRUCTION, HANDS, TWO_HAND_SWITCH, system};
use support::token_game::{flat, variable};

/// Any characters a format could stumble over.
const AWKWARD: &str = "[a-c'_0-9 {}\\\\#<>&\"äβ→😀:*?!()\\[\\]\n\r\t]{0,6}";
/// The same without what XML cannot keep: outer blanks and control characters, and names of no length.
const AWKWARD_IN_XML: &str = "[a-c'_0-9{}\\\\#<>&\"äβ→😀:*?!()\\[\\]]([a-c <>&]{0,4}[a-c}\"])?";

/// Small nets; names are unique among places and among transitions, as they must be.
fn net(name: &'static str) -> impl Strategy<Value = Net> {
    let names =
        || prop::collection::btree_set(name, 0..6).prop_map(|set| set.into_iter().collect::<Vec<_>>()).prop_shuffle();
    let lists = prop::collection::vec([0..6_u8, 0..6, 0..6].prop_map(|list| list.map(usize::from).to_vec()), 3);
    (name, names(), prop::collection::vec(any::<bool>(), 6), names(), prop::collection::vec(lists, 6)).prop_map(
        |(name, places, marked, transitions, lists)| {
            let mut builder = Builder::new(name);
            let ids: Vec<_> =
                places.into_iter().zip(marked).map(|(name, marked)| builder.place(name, marked)).collect();
            for (name, lists) in transitions.into_iter().zip(lists) {
                // Positions beyond the last place mean no arc, so that lists are of any length.
                let list = |i: usize| lists[i].iter().filter_map(|&place| ids.get(place).copied()).collect::<Vec<_>>();
                builder.transition(name, Arcs { consume: &list(0), produce: &list(1), read: &list(2) });
            }
            builder.build()
        },
    )
}

fn from_tina(text: &str) -> Net {
    tina::read(&Source::new("n.net", text)).unwrap_or_else(|errors| panic!("{text}\n{errors:#?}")).net
}

fn from_pnml(text: &str) -> Net {
    pnml::read(&Source::new("n.pnml", text)).unwrap_or_else(|errors| panic!("{text}\n{errors:#?}")).net
}

proptest! {
    #[test]
    fn tina_keeps_every_net(net in net(AWKWARD)) {
        prop_assert_eq!(from_tina(&tina::write(&net)), net);
    }

    #[test]
    fn pnml_keeps_every_net(net in net(AWKWARD_IN_XML)) {
        // A token put where one is read makes an arc of weight 2, which is written, but not read.
        let doubled = net.transitions().any(|t| t.arcs.read.iter().any(|place| t.arcs.produce.contains(place)));
        prop_assume!(!doubled);
        prop_assert_eq!(from_pnml(&pnml::write(&net, Extras::default())), net);
    }

    #[test]
    fn no_text_makes_a_reader_panic(text in "[a-z0-9{}\\\\#<>&\"ä'/=:*?!()\\[\\]\\-\n\r\t ]{0,60}") {
        let _ = tina::read(&Source::new("n.net", text.as_str()));
        let _ = tina::read(&Source::new("n.net", format!("tr {text}")));
        let _ = pnml::read(&Source::new("n.pnml", format!("<pnml><net type='x'>{text}</net></pnml>")));
        let net = format!("<net type='http://www.pnml.org/version-2009/grammar/ptnet'><page id='p'>{text}</page></net>");
        let _ = pnml::read(&Source::new("n.pnml", format!("<pnml>{net}</pnml>")));
    }
}

#[test]
fn a_transition_that_would_double_a_token_has_an_arc_of_weight_2() {
    let mut builder = Builder::new("n");
    let p = builder.place("p", true);
    builder.transition("t", Arcs { consume: &[], produce: &[p], read: &[p] });
    let net = builder.build();
    let text = pnml::write(&net, Extras::default());
    assert_eq!(text.matches("<arc").count(), 2);
    assert!(text.contains("<text>2</text>"), "{text}");
    assert_eq!(from_tina(&tina::write(&net)), net);
}

/// How many markings a net reaches; it must be safe.
fn count_markings(net: &Net, limit: usize) -> Option<usize> {
    let mut seen = BTreeSet::from([net.initial_marking()]);
    let mut queue = VecDeque::from([net.initial_marking()]);
    while let Some(marking) = queue.pop_front() {
        for transition in net.enabled(&marking) {
            let mut next = marking.clone();
            net.fire(&mut next, transition).expect("the net is safe");
            if seen.insert(next.clone()) {
                queue.push_back(next);
            }
        }
        if seen.len() > limit {
            return None;
        }
    }
    Some(seen.len())
}

#[test]
fn the_two_hand_switch_goes_through_every_format_unchanged() {
    let system = system(TWO_HAND_SWITCH, &[HANDS]);
    assert_eq!(Part::ALL.map(|part| system.size(part).0), [52, 7, 4]);
    let source = Source::new("two-hand-switch.il", TWO_HAND_SWITCH);
    let (positions, notes, units) = (positions(&system), notes(&system, &source), system.units());
    let extras = Extras { positions: Some(&positions), notes: Some(&notes), units: Some(&units), ..Extras::default() };
    let text = pnml::write(&system.net, extras);
    let read = from_pnml(&text);
    assert_eq!(read, system.net);
    assert_eq!(from_tina(&tina::write(&system.net)), system.net);
    // 797 by an independent reconstruction of the net.
    assert_eq!(count_markings(&read, 1000), Some(797));
}

#[test]
fn a_plant_that_reads_outputs_goes_through_every_format_unchanged() {
    let system = system(EVERY_INSTRUCTION, &[CYLINDER]);
    assert_eq!(from_pnml(&pnml::write(&system.net, Extras::default())), system.net);
    assert_eq!(from_tina(&tina::write(&system.net)), system.net);
}

#[test]
fn tool_sections_say_what_nodes_stand_for() {
    let system = system(TWO_HAND_SWITCH, &[HANDS]);
    let notes = notes(&system, &Source::new("two-hand-switch.il", TWO_HAND_SWITCH));
    let of_place = |name: &str| {
        let note = &notes.places[system.net.find_place(name).unwrap().index()];
        note.iter().map(|(word, value)| format!("{word}={value}")).collect::<Vec<_>>().join(" ")
    };
    assert_eq!(of_place("S1=1"), "part=user role=variable variable=S1 value=1");
    assert_eq!(of_place("CR=0"), "part=user role=result value=0");
    // `OR O2` is in line 24 of the file; the parenthesis before it takes three lines of code.
    assert_eq!(of_place("line_13"), "part=user role=line line=13 source-line=24");
    assert_eq!(of_place("End"), "part=user role=line line=30");
    assert_eq!(of_place("idle"), "part=system role=idle");
    assert_eq!(of_place("copy_O1"), "part=system role=copy variable=O1");
    assert_eq!(of_place("block_hands.2"), "part=system role=blocking component=hands.2");
    assert_eq!(of_place("hands.S2=1,O2=0"), "part=plant role=plant component=hands.2");
    let of_transition = |name: &str| {
        let note = &notes.transitions[system.net.find_transition(name).unwrap().index()];
        note.iter().map(|(word, value)| format!("{word}={value}")).collect::<Vec<_>>().join(" ")
    };
    assert_eq!(of_transition("line_1[CR=0,Step_0=1]"), "part=user role=line line=1 source-line=13");
    assert_eq!(of_transition("copy_S1[0->1 from hands.S1=1,O1=0]"), "part=system role=copy variable=S1 value=1");
    assert_eq!(of_transition("hands.press2"), "part=plant role=plant component=hands.2");
}

/// The public contest models have the sizes they should have; the safe ones have the states, too.
#[test]
fn contest_models_are_read() {
    let Some(data) = std::env::var_os("PETRIL_DATA") else {
        println!("PETRIL_DATA is not set: no contest models");
        return;
    };
    let folder = std::path::Path::new(&data).join("mcc");
    let mut archives: Vec<_> = std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    archives.sort();
    let (mut weighted, mut counted) = (Vec::new(), 0);
    for archive in archives.iter().filter(|path| path.extension().is_some_and(|e| e == "tgz")) {
        let name = archive.file_stem().unwrap().to_str().unwrap().to_owned();
        let member = |path: String| {
            let output = Command::new("tar").arg("xzOf").arg(archive).arg(path).output().unwrap();
            String::from_utf8(output.stdout).unwrap()
        };
        let text = member(format!("{name}/model.pnml"));
        let located = pnml::read(&Source::new("model.pnml", text.as_str())).unwrap_or_else(|e| panic!("{name}: {e:?}"));
        if !located.not_safe.is_empty() {
            weighted.push(name.clone());
        }
        let net = located.net;
        let count = |tag: &str| text.matches(tag).count();
        assert_eq!(net.places().len(), count("<place "), "{name}");
        assert_eq!(net.transitions().len(), count("<transition "), "{name}");
        assert_eq!(net.arc_count(), count("<arc "), "{name}");
        assert_eq!(from_pnml(&pnml::write(&net, Extras::default())), net, "{name}");
        assert_eq!(from_tina(&tina::write(&net)), net, "{name}");
        let oracle = member(format!("{name}/oracle/{name}-SS.out"));
        let states =
            oracle.lines().find_map(|line| line.strip_prefix("STATE_SPACE STATES ")?.split(' ').next()?.parse().ok());
        if let Some(states) = states.filter(|&states: &usize| states <= 3000 && located.not_safe.is_empty()) {
            assert_eq!(count_markings(&net, 3000), Some(states), "{name}");
            counted += 1;
        }
    }
    assert_eq!(weighted, ["FMS-PT-00002", "HouseConstruction-PT-00002", "Kanban-PT-00005", "SwimmingPool-PT-01"]);
    assert!(counted >= 10, "{counted}");
}

/// What is said of the nodes that only wide data has.
#[test]
fn nodes_of_wide_data_have_notes() {
    let sint = Type::named("SINT").unwrap();
    let operand = Operand::Place(Target::Variable(VarId(0)));
    let code = vec![Instruction::Combine { function: Function::Mul, ty: sint, negated: false, operand }];
    let system = System::new(flat(vec![variable("x", Role::Input, sint)], code), Plant::default());
    let notes = notes(&system, &Source::new("x.il", "MUL x"));
    let words =
        |note: &[(&str, String)]| note.iter().map(|(word, value)| format!("{word}={value}")).collect::<Vec<_>>();
    let place = |name: &str| words(&notes.places[system.net.find_place(name).unwrap().index()]).join(" ");
    assert_eq!(place("x.3=1"), "part=user role=variable variable=x bit=3 value=1");
    assert_eq!(place("CR.0=0"), "part=user role=result bit=0 value=0");
    assert_eq!(place("operand'.8=0"), "part=user role=register register=operand bit=8 value=0");
    assert_eq!(place("mark'=1"), "part=user role=register register=mark bit=0 value=1");
    assert_eq!(place("line_1.1"), "part=user role=within-line line=1 source-line=1");
    assert_eq!(place("line_1.overflow"), "part=user role=hazard hazard=overflow line=1 source-line=1");
    assert_eq!(place("copy_x.7"), "part=system role=copying variable=x");
    let copy = system.net.find_transition("copy_x[x.7:0->1]").unwrap();
    assert_eq!(words(&notes.transitions[copy.index()]).join(" "), "part=system role=copy variable=x bit=7 value=1");
}
