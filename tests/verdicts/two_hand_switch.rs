//! The seed paper's example, held to what was found without Petril: counts from an independent reconstruction of the net and
//! from a reference compiler's code, and a model of the program written here by hand.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::AtomicBool;

use petril::explore::engine::{self, Model, Options};
use petril::explore::{Budget, Graph, Markings, ScanSpace, explore};
use petril::semantics::Role;
use petril::translate::{Part, System};
use support::reports::{answer, counterexample, moves, report, values, verdicts};
use support::systems::{HANDS, TWO_HAND_SWITCH, system};

const REQUIREMENTS: &str = include_str!("../../examples/two-hand-switch.req");
const BROKEN: &str = include_str!("../../examples/two-hand-switch-broken.il");

/// Steps and output, as the program has them at the end of a scan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Memory {
    step: [bool; 3],
    output: bool,
}

/// The switches: closers and openers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Hands {
    s: [bool; 2],
    o: [bool; 2],
}

const POWER_ON: Memory = Memory { step: [true, false, false], output: false };

/// One scan, after the paper's listing: lines 13 to 19, 20 to 29, 30 and 31, 32 to 38.
fn scan(mut memory: Memory, Hands { s, o }: Hands) -> Memory {
    if memory.step[0] && s[0] && s[1] && !o[0] && !o[1] {
        memory.step[0] = false;
        memory.step[1] = true;
    }
    memory.output |= memory.step[1];
    if memory.step[1] && (o[0] || o[1] || !s[0] || !s[1]) {
        memory.step[1] = false;
        memory.step[2] = true;
    }
    memory.output &= !memory.step[2];
    if memory.step[2] && !s[0] && !s[1] && o[0] && o[1] {
        memory.step[2] = false;
        memory.step[0] = true;
    }
    memory
}

/// All that can happen with these hands: each state at the end of a scan, with the scans it takes to get there.
fn reachable(hands: &[Hands]) -> BTreeMap<(Memory, Hands), usize> {
    let mut depth = BTreeMap::new();
    let mut level: Vec<Memory> = vec![POWER_ON];
    for scans in 1.. {
        let next: BTreeSet<(Memory, Hands)> =
            level.iter().flat_map(|&memory| hands.iter().map(move |&hands| (scan(memory, hands), hands))).collect();
        level = next.iter().filter(|state| !depth.contains_key(*state)).map(|state| state.0).collect();
        if level.is_empty() {
            break;
        }
        next.into_iter().for_each(|state| _ = depth.entry(state).or_insert(scans));
    }
    depth
}

fn all_hands() -> Vec<Hands> {
    let bit = |n: u8, i: u8| n >> i & 1 == 1;
    (0..16).map(|n| Hands { s: [bit(n, 0), bit(n, 1)], o: [bit(n, 2), bit(n, 3)] }).collect()
}

/// The states of the scan view in the terms above, each with its depth.
fn explored(system: &System) -> BTreeMap<(Memory, Hands), usize> {
    let space = ScanSpace::new(system);
    let graph: Graph = explore(&space, Budget::default(), &mut |_| None);
    assert!(graph.is_complete());
    let state = |id: u32| {
        let value = |name: &str| space.value(graph.state(id), system.program.find(name).unwrap()) == 1;
        let step = ["Step_0", "Step_1", "Step_2"].map(value);
        let hands = Hands { s: ["S1", "S2"].map(value), o: ["O1", "O2"].map(value) };
        ((Memory { step, output: value("Output") }, hands), graph.path_to(id).len())
    };
    graph.ids().map(state).collect()
}

#[test]
fn the_net_has_its_size() {
    let system = system(TWO_HAND_SWITCH, &[HANDS]);
    // Ten bits (four inputs, three steps, the output, two buffers) and the current result make 22 places, 29 lines and the
    // end 30. Each of the 29 instructions combines two values of two bits: 4 transitions.
    assert_eq!(system.size(Part::User), (52, 29 * 4));
    // `idle`, four inputs to copy, two blocking places; `block`, `unblock`, and for each input old and new value.
    assert_eq!(system.size(Part::System), (7, 2 + 4 * 4));
    assert_eq!(system.size(Part::Plant), (4, 4));
    assert_eq!((system.net.places().len(), system.net.transitions().len()), (63, 138));
}

#[test]
fn the_net_behaves_as_the_paper_says() {
    let system = system(TWO_HAND_SWITCH, &[HANDS]);
    let markings = Markings::explored(&system.net, Budget::default(), &mut |_| None);
    assert_eq!(markings.graph().len(), 797);
    assert!(markings.graph().failures().is_empty(), "the net is safe");
    let options = Options { keep: true, ..Options::default() };
    let behaviour = engine::explore(&Model::from(&system.net), &options, &mut |_| None, None)
        .behaviour(&AtomicBool::new(false))
        .unwrap();
    assert_eq!(behaviour.deadlocks, 0);
    assert!(behaviour.live_without_dead);
    // Each instruction has a transition for every combination of values, and not every combination comes about.
    assert!(!behaviour.dead.is_empty());
}

#[test]
fn the_flat_code_is_figure_9() {
    let figure = "LD Step_0, AND S1, AND S2, ANDN O1, ANDN O2, R Step_0, S Step_1, LD Step_1, S Output, LD Step_1, ST A, \
                  LD O1, OR O2, ORN S1, ORN S2, ST B, LD A, AND B, R Step_1, S Step_2, LD Step_2, R Output, LD Step_2, \
                  ANDN S1, ANDN S2, AND O1, AND O2, R Step_2, S Step_0";
    let program = support::program(TWO_HAND_SWITCH);
    let words = |text: String| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let code: Vec<String> = program.code.iter().map(|line| words(program.text(line.instruction))).collect();
    assert_eq!(code, figure.split(", ").collect::<Vec<_>>());
    let names = |role| program.with_role(role).map(|id| program.variable(id).name.as_str()).collect::<Vec<_>>();
    assert_eq!(names(Role::Memory), ["Step_0", "Step_1", "Step_2"]);
    assert_eq!(names(Role::Input), ["S1", "S2", "O1", "O2"]);
    assert_eq!(names(Role::Output), ["Output"]);
    assert_eq!(names(Role::Buffer), ["A", "B"]);
    let initial: Vec<u64> = program.variables.iter().map(|variable| variable.initial).collect();
    assert_eq!(initial, [1, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
}

#[test]
fn with_free_inputs_there_are_31_states() {
    let by_hand = reachable(&all_hands());
    assert_eq!(by_hand.len(), 31);
    assert_eq!(by_hand.values().max(), Some(&3));
    assert_eq!(by_hand.keys().map(|(memory, _)| memory).collect::<BTreeSet<_>>().len(), 3);
    assert_eq!(explored(&system(TWO_HAND_SWITCH, &[])), by_hand);
}

#[test]
fn with_its_switches_there_are_7_states() {
    let complementary: Vec<Hands> = all_hands().into_iter().filter(|h| h.s[0] != h.o[0] && h.s[1] != h.o[1]).collect();
    let by_hand = reachable(&complementary);
    assert_eq!(by_hand.len(), 7);
    assert_eq!(explored(&system(TWO_HAND_SWITCH, &[HANDS])), by_hand);
}

#[test]
fn nine_requirements_hold_and_one_does_not() {
    let system = system(TWO_HAND_SWITCH, &[HANDS]);
    let report = report(&system, REQUIREMENTS);
    let holds = [
        "both_hands",
        "one_step",
        "stops_at_once",
        "starts_at_once",
        "no_restart",
        "can_start",
        "starts_again",
        "back_to_rest",
        "switches_agree",
    ];
    let expected: Vec<_> = holds.map(|name| (name, "holds")).into_iter().chain([("synchronous", "violated")]).collect();
    assert_eq!(verdicts(&report), expected);
    assert_eq!(report.exploration.depth, 3);

    // One hand alone, then the other as well. Which hand is first does not matter: the search takes the second.
    let trace = counterexample(&report, "synchronous");
    let names = ["S1", "S2", "O1", "O2", "Step_0", "Step_1", "Step_2", "Output"];
    assert_eq!(values(&system, trace, &names), ["01101000", "11000101"]);
    assert_eq!(moves(&system, trace), [["hands.press2"], ["hands.press1"]]);
    assert_eq!(trace.loop_start, None);
    let petril::verdict::Outcome::Violated(witness, _) = &answer(&report, "synchronous").outcome else { panic!() };
    let notes: Vec<_> = witness.notes.iter().map(|note| (note.first, note.last, note.text.as_str())).collect();
    assert_eq!(notes, [(0, 0, "`S1 & !S2 | !S1 & S2` is true"), (1, 1, "`Output` is true")]);
}

#[test]
fn the_broken_twin_works_with_one_hand() {
    let system = system(BROKEN, &[HANDS]);
    let report = report(&system, REQUIREMENTS);
    let violated: Vec<_> = verdicts(&report).into_iter().filter(|(_, verdict)| *verdict != "holds").collect();
    assert_eq!(violated, [("no_restart", "violated"), ("synchronous", "violated")]);
    // Both hands, then the first lets go and presses again while the second stays down.
    let trace = counterexample(&report, "no_restart");
    let names = ["S1", "S2", "Step_0", "Step_1", "Step_2", "Output"];
    assert_eq!(values(&system, trace, &names), ["110101", "011000", "110101"]);
    assert_eq!(moves(&system, trace)[1..], [["hands.release1"], ["hands.press1"]]);
}
