//! Figures of a campaign.

use std::collections::{BTreeMap, HashMap};
use std::fs;
use std::path::Path;

use crate::process::Test;
use crate::run;

const HEAD: &str = "| folder | made | unviable | tried | caught | timed out | survived | open | not tried |
|---|--:|--:|--:|--:|--:|--:|--:|--:|";

/// A fault is open if some of the tests that come to it were not run, since they would have taken too long.
pub fn report(copy: &Path, survivors: bool) {
    let (faults, unviable) = run::table(copy);
    let known = run::outcomes(copy);
    let tests: Vec<Test> =
        serde_json::from_slice(&fs::read(copy.join("tests.json")).expect("measure first")).expect("tests");
    let mut reaching: HashMap<u32, usize> = HashMap::new();
    tests.iter().flat_map(|test| &test.reached).for_each(|fault| *reaching.entry(*fault).or_default() += 1);
    let mut rows: BTreeMap<&str, [usize; 8]> = BTreeMap::new();
    for fault in &faults {
        let folder = fault.file.rsplit_once('/').map_or("", |(folder, _)| folder);
        let outcome = known.get(&fault.number).filter(|_| !unviable.contains(&fault.number));
        let all = reaching.get(&fault.number).copied().unwrap_or(0);
        let column = match outcome {
            _ if unviable.contains(&fault.number) => 1,
            Some(outcome) if outcome.outcome == "caught" => 3,
            Some(outcome) if outcome.outcome == "timed out" => 4,
            Some(outcome) if outcome.tried >= all => 5,
            Some(_) => 6,
            None => 7,
        };
        for row in [folder, "all"] {
            let row = rows.entry(row).or_default();
            row[0] += 1;
            row[2] += usize::from(outcome.is_some());
            row[column] += 1;
        }
        if let Some(outcome) = outcome.filter(|outcome| survivors && outcome.outcome == "survived") {
            let (tried, at) = (outcome.tried, format!("{}:{}:{}", fault.file, fault.line, fault.column));
            let state = if column == 5 { "survived" } else { "open" };
            println!("{state} {} {at} {} `{}` -> `{}`", fault.number, fault.kind, fault.original, fault.replacement);
            println!("    in {}, {tried} of {all} tests", fault.function);
        }
    }
    if !survivors {
        println!("{HEAD}");
        for (folder, row) in rows {
            println!("| `{folder}` | {} |", row.map(|count| count.to_string()).join(" | "));
        }
    }
}
