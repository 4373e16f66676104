//! Figures of a campaign.

use std::collections::BTreeMap;
use std::path::Path;

use crate::run;

pub fn report(copy: &Path, survivors: bool) {
    let (faults, unviable) = run::table(copy);
    let known = run::outcomes(copy);
    let mut rows: BTreeMap<&str, [usize; 7]> = BTreeMap::new();
    for fault in &faults {
        let folder = fault.file.rsplit_once('/').map_or("", |(folder, _)| folder);
        let outcome = known.get(&fault.number).filter(|_| !unviable.contains(&fault.number));
        let column = match outcome {
            _ if unviable.contains(&fault.number) => 1,
            Some(outcome) if outcome.outcome == "caught" => 3,
            Some(outcome) if outcome.outcome == "timed out" => 4,
            Some(_) => 5,
            None => 6,
        };
        for row in [folder, "all"] {
            let row = rows.entry(row).or_default();
            row[0] += 1;
            row[2] += usize::from(outcome.is_some());
            row[column] += 1;
        }
        if let Some(outcome) = outcome.filter(|outcome| survivors && outcome.outcome == "survived") {
            println!(
                "{} {}:{}:{} {} [{}] `{}` -> `{}` ({} of {} tests)",
                fault.number,
                fault.file,
                fault.line,
                fault.column,
                fault.function,
                fault.kind,
                fault.original,
                fault.replacement,
                outcome.tried,
                outcome.reaching
            );
        }
    }
    if !survivors {
        println!(
            "| folder | made | unviable | tried | caught | timed out | survived | not tried |\n|---|--:|--:|--:|--:|--:|--:|--:|"
        );
        for (folder, row) in rows {
            println!("| `{folder}` | {} |", row.map(|count| count.to_string()).join(" | "));
        }
    }
}
