//! Programs with numbers: the ends of scans that the interpreter computes are those that the net comes to.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::collections::BTreeSet;

use petril::explore::{Budget, Markings, ScanSpace, explore};
use petril::flat::Tolerated;
use petril::semantics::VarId;
use petril::translate::{Domain, Domains, PlaceRole, Plant, System};
use proptest::prelude::*;
use support::assembler::{assemble, ty};

fn piece() -> impl Strategy<Value = String> {
    let function = || proptest::sample::select(vec!["ADD", "SUB", "MUL", "DIV", "MOD"]);
    let comparison = || proptest::sample::select(vec!["GT", "GE", "EQ", "NE", "LE", "LT"]);
    let number = || proptest::sample::select(vec!["m", "n", "k", "-128", "-1", "0", "2", "127"]);
    prop_oneof![
        3 => (function(), number(), number()).prop_map(|(f, a, b)| format!("LD m\n{f} {a}\nMOD 5\n{f} {b}\nST m")),
        2 => (function(), number()).prop_map(|(f, a)| format!("LD k\n{f} {a}\nMOD 3\nTO INT\nST w\nTO SINT\nST n")),
        2 => (comparison(), number()).prop_map(|(f, a)| format!("LD n\n{f} {a}\nST q\nLD k\n{f} {a}\nXOR q\nST q")),
        1 => number().prop_map(|a| format!("LD q\nR q\nLD m\nEQ {a}\nS q")),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn on_the_ends_of_scans(pieces in proptest::collection::vec(piece(), 1..4), inputs in 1..8_u32) {
        let program = assemble("in k SINT\nvar m SINT -3\nvar n SINT 1\nvar w INT\nout q BOOL", &pieces.join("\n"));
        let k = program.find("k").unwrap();
        let values = [-128, 0, 3].into_iter().zip(0..).filter(|(_, bit)| inputs >> bit & 1 == 1);
        let domain = Domain::new(ty("SINT"), values.map(|(value, _)| (value, value)).collect()).unwrap();
        let system = System::with_domains(program, Plant::default(), Domains::from([(k, domain)]));
        let declared: Vec<VarId> = system.program.declared().collect();

        let scans = ScanSpace::tolerating(&system, Tolerated { overflow: true, division_by_zero: true });
        let graph = explore(&scans, Budget::default(), &mut |_| None);
        prop_assert!(graph.is_complete());
        let value = |state: &[u64]| declared.iter().map(|&id| scans.value(state, id)).collect::<Vec<u64>>();
        let from_scans: BTreeSet<Vec<u64>> = graph.ids().map(|id| value(graph.state(id))).collect();
        prop_assert_eq!(from_scans.len(), graph.len());

        let markings = Markings::explored(&system.net, Budget::default(), &mut |_| None);
        let all = markings.graph();
        let end = system.place(PlaceRole::Line(system.program.end()));
        let at_end = all.ids().map(|id| all.state(id)).filter(|state| markings.is_marked(state, end));
        let value = |state, id| system.value(id, |place| markings.is_marked(state, place)).unwrap();
        let from_markings: BTreeSet<Vec<u64>> =
            at_end.map(|state| declared.iter().map(|&id| value(state, id)).collect()).collect();
        prop_assert_eq!(from_scans, from_markings);
    }
}
