//! Prints a net of N places and N transitions with 4 N arcs as PNML, for the figures on large nets in docs/performance.md:
//! `cargo bench --bench large_net -- 100000 > net.pnml`.
//!
//! A token goes around a ring of all places; each step reads a place far away, which is marked at the beginning if it is one
//! in ten.

use std::io::{self, BufWriter, Write};

fn main() -> io::Result<()> {
    // Without a number this is a run of the tests, which has nothing to print.
    let count = std::env::args().find_map(|argument| argument.parse::<usize>().ok());
    match count {
        Some(count) => print(count, &mut BufWriter::new(io::stdout().lock())),
        None => Ok(()),
    }
}

fn print(count: usize, out: &mut impl Write) -> io::Result<()> {
    let grammar = "http://www.pnml.org/version-2009/grammar";
    writeln!(out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<pnml xmlns=\"{grammar}/pnml\">")?;
    writeln!(out, "  <net id=\"net\" type=\"{grammar}/ptnet\">\n    <page id=\"page\">")?;
    for i in 0..count {
        writeln!(out, "      <place id=\"place_{i}\">\n        <name><text>place_{i}</text></name>")?;
        if i % 10 == 0 {
            writeln!(out, "        <initialMarking><text>1</text></initialMarking>")?;
        }
        writeln!(out, "      </place>")?;
    }
    for i in 0..count {
        let name = format!("<name><text>transition_{i}</text></name>");
        writeln!(out, "      <transition id=\"transition_{i}\">\n        {name}\n      </transition>")?;
    }
    for i in 0..count {
        let (next, far) = ((i + 1) % count, (i + count / 2) % count);
        let [here, next, far] = [i, next, far].map(|place| format!("place_{place}"));
        let ends = [(0, &here, true), (1, &far, true), (2, &far, false), (3, &next, false)];
        for (number, place, takes) in ends {
            let transition = format!("transition_{i}");
            let (source, target) = if takes { (place, &transition) } else { (&transition, place) };
            writeln!(out, "      <arc id=\"arc_{i}_{number}\" source=\"{source}\" target=\"{target}\"/>")?;
        }
    }
    writeln!(out, "    </page>\n  </net>\n</pnml>")?;
    out.flush()
}
