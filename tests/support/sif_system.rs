//! Large specifications of safety functions, and programs that compute them. Made by a generator whose stream is defined, so that
//! a size and a seed mean one system for ever.
//!
//! A zone has modes (of which one at most is on), doors, keys and elements that stop the beam. Its functions are interlocks over
//! these, over functions of the same zone that come before, and over the last function of the zone before it.

use std::fmt::Write;

/// How large a system is.
#[derive(Clone, Copy, Debug)]
pub struct Size {
    pub inputs: usize,
    pub zones: usize,
    pub functions: usize,
}

/// A personnel protection system of a large site.
#[allow(dead_code, reason = "not every test needs one so large")]
pub const LARGE: Size = Size { inputs: 350, zones: 19, functions: 200 };

/// A specification, and a program that computes it.
pub struct Made {
    pub specification: String,
    pub program: String,
}

/// Numbers by chance (a linear congruential generator; its upper bits).
struct Lots(u64);

impl Lots {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % bound
    }
}

/// A formula: an operator of IL and its operands, or a name that may be negated.
enum Formula {
    Name(String, bool),
    Join(&'static str, Vec<Formula>),
}

impl Formula {
    fn text(&self) -> String {
        match self {
            Self::Name(name, is_negated) => format!("{}{name}", if *is_negated { "!" } else { "" }),
            Self::Join(operator, operands) => {
                let symbol = if *operator == "AND" { " & " } else { " | " };
                format!("({})", operands.iter().map(Self::text).collect::<Vec<_>>().join(symbol))
            }
        }
    }

    /// The instructions that make it the current result.
    fn load(&self, code: &mut String) {
        match self {
            Self::Name(name, is_negated) => {
                writeln!(code, "        LD{:6} {name}", if *is_negated { "N" } else { "" }).unwrap();
            }
            Self::Join(operator, operands) => {
                operands[0].load(code);
                for operand in &operands[1..] {
                    match operand {
                        Self::Name(name, is_negated) => {
                            let operator = format!("{operator}{}", if *is_negated { "N" } else { "" });
                            writeln!(code, "        {operator:8} {name}").unwrap();
                        }
                        Self::Join(..) => {
                            writeln!(code, "        {operator}(").unwrap();
                            operand.load(code);
                            writeln!(code, "        )").unwrap();
                        }
                    }
                }
            }
        }
    }
}

/// A system of a size.
pub fn made(size: Size, seed: u64) -> Made {
    let mut lots = Lots(seed);
    let (mut specification, mut code) = (String::from("system \"A generated site\";\n"), String::new());
    let (mut declared_in, mut declared_out) = (String::new(), String::new());
    let mut last_of_zone_before: Option<String> = None;
    for zone in 1..=size.zones {
        let share = |all: usize| all * zone / size.zones - all * (zone - 1) / size.zones;
        let inputs: Vec<String> = (0..share(size.inputs))
            .map(|position| match position {
                0 => format!("Z{zone}_Access"),
                1 => format!("Z{zone}_Beam"),
                2 => format!("Z{zone}_Test"),
                _ => format!("Z{zone}_{}{position}", ["Door", "Key", "Stopper", "Alarm"][position % 4]),
            })
            .collect();
        writeln!(specification, "zone Z{zone} \"Zone {zone}\" {{").unwrap();
        for input in &inputs {
            writeln!(specification, "    input {input} \"{}\";", input.replace('_', " ")).unwrap();
            writeln!(declared_in, "        {input} : BOOL;").unwrap();
        }
        writeln!(specification, "    restriction Z{zone}_Modes: at most one of {};", inputs[..3].join(", ")).unwrap();
        writeln!(specification, "    restriction Z{zone}_Keys: never {} & !{} & !{};", inputs[1], inputs[4], inputs[5])
            .unwrap();
        let mut outputs: Vec<String> = Vec::new();
        for number in 1..=share(size.functions) {
            let name = format!("Z{zone}_F{number}");
            // Each function looks at a part of the zone; one in four also at what another function says.
            let mut names: Vec<String> = Vec::new();
            let wanted = (4 + lots.below(6)).min(inputs.len());
            while names.len() < wanted {
                let name = &inputs[lots.below(inputs.len())];
                if !names.contains(name) {
                    names.push(name.clone());
                }
            }
            if lots.below(4) == 0 {
                let other = outputs.get(lots.below(outputs.len() + 1)).or(last_of_zone_before.as_ref());
                names.extend(other.cloned());
            }
            let formula = formula(&names, &mut lots);
            writeln!(specification, "    function {name} \"Interlock {number} of zone {zone}\" {{").unwrap();
            writeln!(specification, "        informal {{ sil: {}; }}", 1 + lots.below(3)).unwrap();
            writeln!(specification, "        interface {{").unwrap();
            names.iter().for_each(|name| writeln!(specification, "            input {name};").unwrap());
            writeln!(specification, "            output {name};\n        }}").unwrap();
            writeln!(specification, "        formal {{ {name} = {}; }}\n    }}", formula.text()).unwrap();
            formula.load(&mut code);
            writeln!(code, "        ST       {name}").unwrap();
            writeln!(declared_out, "        {name} : BOOL;").unwrap();
            outputs.push(name);
        }
        writeln!(specification, "}}").unwrap();
        last_of_zone_before = outputs.last().cloned();
    }
    let program = format!(
        "PROGRAM site\n    VAR_INPUT\n{declared_in}    END_VAR\n    VAR_OUTPUT\n{declared_out}    END_VAR\n{code}END_PROGRAM\n"
    );
    Made { specification, program }
}

/// A disjunction of terms that names everything once, and some things twice.
fn formula(names: &[String], lots: &mut Lots) -> Formula {
    let literal = |name: &String, lots: &mut Lots| Formula::Name(name.clone(), lots.below(2) == 0);
    let terms = 2 + lots.below(2);
    let mut parts: Vec<Vec<Formula>> = (0..terms).map(|_| Vec::new()).collect();
    for (position, name) in names.iter().enumerate() {
        parts[position % terms].push(literal(name, lots));
    }
    let first = lots.below(names.len());
    let second = (first + 1 + lots.below(names.len() - 1)) % names.len();
    let group = Formula::Join("OR", vec![literal(&names[first], lots), literal(&names[second], lots)]);
    parts[lots.below(terms)].push(group);
    let term = |mut part: Vec<Formula>| if part.len() == 1 { part.remove(0) } else { Formula::Join("AND", part) };
    Formula::Join("OR", parts.into_iter().map(term).collect())
}
