//! Every picture, measured: what is drawn is the net, and nothing covers anything else.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::draw::{diagram, positions, subnet, surroundings};
use petril::flat::{Condition, Element, Function, Instruction, Operand, Target};
use petril::semantics::{Role, Type, VarId};
use petril::translate::{Plant, System, TransitionRole};
use roxmltree::{Document, Node};
use support::systems::{CYLINDER, EVERY_INSTRUCTION, HANDS, TWO_HAND_SWITCH, system};
use support::token_game::{flat, variable};

/// A box; a text is the box around it.
#[derive(Clone, Debug)]
struct Area {
    what: String,
    left: f64,
    top: f64,
    right: f64,
    bottom: f64,
}

impl Area {
    fn overlaps(&self, other: &Area) -> bool {
        self.left < other.right && other.left < self.right && self.top < other.bottom && other.top < self.bottom
    }

    fn holds(&self, (x, y): (f64, f64)) -> bool {
        self.left < x && x < self.right && self.top < y && y < self.bottom
    }
}

/// The shapes of a picture.
#[derive(Default)]
struct Shapes {
    sheet: Option<Area>,
    white: Vec<Area>,
    grey: Vec<Area>,
    tokens: usize,
    boxes: Vec<Area>,
    texts: Vec<Area>,
    arrows: Vec<[(f64, f64); 2]>,
    dots: Vec<[(f64, f64); 2]>,
}

fn number(node: Node<'_, '_>, name: &str) -> f64 {
    node.attribute(name).and_then(|value| value.parse().ok()).unwrap_or_else(|| panic!("{name} of {node:?}"))
}

fn shapes(svg: &str) -> Shapes {
    let document = Document::parse(svg).unwrap();
    let mut shapes = Shapes::default();
    for node in document.descendants().filter(|node| node.ancestors().all(|n| !n.has_tag_name("defs"))) {
        let group = |name: &str| node.parent().and_then(|parent| parent.attribute(name).map(str::to_owned));
        let fill = group("fill").unwrap_or_default();
        match node.tag_name().name() {
            "circle" => {
                let (x, y, r) = (number(node, "cx"), number(node, "cy"), number(node, "r"));
                let area = Area { what: "place".into(), left: x - r, top: y - r, right: x + r, bottom: y + r };
                match fill.as_str() {
                    "#fff" => shapes.white.push(area),
                    "#ddd" => shapes.grey.push(area),
                    _ => shapes.tokens += 1,
                }
            }
            "rect" => {
                let at = |name| node.attribute(name).map_or(0.0, |_| number(node, name));
                let (left, top) = (at("x"), at("y"));
                let (right, bottom) = (left + number(node, "width"), top + number(node, "height"));
                let area = Area { what: "box".into(), left, top, right, bottom };
                if shapes.sheet.is_none() { shapes.sheet = Some(area) } else { shapes.boxes.push(area) }
            }
            "text" => {
                let text = node.text().unwrap_or_default();
                // DejaVu Sans Mono, 11 units high.
                let (width, x, y) = (6.63 * text.chars().count() as f64, number(node, "x"), number(node, "y"));
                let left = match node.attribute("text-anchor") {
                    Some("middle") => x - width / 2.0,
                    Some("end") => x - width,
                    _ => x,
                };
                shapes.texts.push(Area { what: text.into(), left, top: y - 8.0, right: left + width, bottom: y + 2.5 });
            }
            "path" => {
                let d = node.attribute("d").unwrap().replace(['M', 'L'], " ");
                let numbers: Vec<f64> = d.split_whitespace().map(|n| n.parse().unwrap()).collect();
                let ends = [(numbers[0], numbers[1]), (numbers[2], numbers[3])];
                let marker = group("marker-end").unwrap_or_default();
                if marker.contains("dot") { shapes.dots.push(ends) } else { shapes.arrows.push(ends) }
            }
            _ => {}
        }
    }
    shapes
}

/// Nothing overlaps, nothing sticks out, no arc goes through a node or a name.
fn assert_legible(svg: &str) -> Shapes {
    let shapes = shapes(svg);
    let sheet = shapes.sheet.clone().expect("a sheet");
    let captions = |text: &&Area| {
        shapes.boxes.iter().any(|b| b.holds((text.left, text.top)) && b.holds((text.right, text.bottom)))
    };
    let places: Vec<&Area> = shapes.white.iter().chain(&shapes.grey).collect();
    let names: Vec<&Area> = shapes.texts.iter().filter(|text| !captions(text)).collect();
    let all: Vec<&Area> = places.iter().copied().chain(&shapes.boxes).chain(names.iter().copied()).collect();
    for (i, a) in all.iter().enumerate() {
        assert!(sheet.holds((a.left, a.top)) && sheet.holds((a.right, a.bottom)), "{a:?} sticks out of {sheet:?}");
        for b in &all[i + 1..] {
            assert!(!a.overlaps(b), "{a:?} overlaps {b:?}");
        }
    }
    for &[from, to] in shapes.arrows.iter().chain(&shapes.dots) {
        // One step short of both ends, which touch the nodes they join.
        for i in 1..40 {
            let t = f64::from(i) / 40.0;
            let point = (from.0 + t * (to.0 - from.0), from.1 + t * (to.1 - from.1));
            for area in all.iter().filter(|area| area.holds(point)) {
                let centre = ((area.left + area.right) / 2.0, (area.top + area.bottom) / 2.0);
                let outside = area.what == "place"
                    && (point.0 - centre.0).hypot(point.1 - centre.1) >= (area.right - area.left) / 2.0;
                assert!(outside, "an arc from {from:?} to {to:?} goes through {area:?}");
            }
        }
    }
    shapes
}

/// Arcs and read arcs of some transitions.
fn arcs(system: &System, of: impl Fn(TransitionRole) -> bool) -> (usize, usize) {
    let ids = system.net.transition_ids().filter(|id| of(system.transitions[id.index()]));
    ids.map(|id| system.net.arcs(id))
        .fold((0, 0), |(arcs, reads), a| (arcs + a.consume.len() + a.produce.len(), reads + a.read.len()))
}

fn assert_diagram(system: &System) {
    let shapes = assert_legible(&diagram(system).svg());
    assert_eq!(shapes.white.len(), system.net.places().len(), "every place once as itself");
    assert_eq!(shapes.boxes.len(), system.net.transitions().len());
    assert_eq!((shapes.arrows.len(), shapes.dots.len()), arcs(system, |_| true));
}

#[test]
fn the_subnet_of_every_instruction_is_drawn_whole_and_legible() {
    let system = system(EVERY_INSTRUCTION, &[CYLINDER]);
    for line in 0..system.program.end() {
        let text = system.program.text(system.program.code[line].instruction);
        let shapes = assert_legible(&subnet(&system, line, Some(&text)).svg());
        let transitions: Vec<_> = system.transitions_of(TransitionRole::Line(line)).collect();
        let mut places: Vec<_> = transitions
            .iter()
            .map(|&id| system.net.arcs(id))
            .flat_map(|arcs| arcs.consume.iter().chain(arcs.produce).chain(arcs.read))
            .collect();
        places.sort_unstable();
        places.dedup();
        assert_eq!(shapes.boxes.len(), transitions.len(), "{text}");
        assert_eq!((shapes.white.len(), shapes.grey.len()), (places.len(), 0), "{text}");
        assert_eq!(
            (shapes.arrows.len(), shapes.dots.len()),
            arcs(&system, |role| role == TransitionRole::Line(line)),
            "{text}"
        );
        assert_eq!(
            shapes.tokens,
            places.iter().filter(|&&&place| system.net.place(place).is_marked()).count(),
            "{text}"
        );
    }
}

#[test]
fn a_whole_system_is_drawn_whole_and_legible() {
    assert_diagram(&system(TWO_HAND_SWITCH, &[HANDS]));
    for (system, components) in [(system(TWO_HAND_SWITCH, &[HANDS]), 2), (system(EVERY_INSTRUCTION, &[CYLINDER]), 1)] {
        let pictures = surroundings(&system);
        assert_eq!(pictures.len(), 1 + components);
        for picture in pictures {
            assert_legible(&picture.svg());
        }
    }
    assert_diagram(&system(TWO_HAND_SWITCH, &[]));
    assert_diagram(&system(EVERY_INSTRUCTION, &[CYLINDER]));
    assert_diagram(&system("PROGRAM least VAR q : BOOL; END_VAR\nLD q\nEND_PROGRAM", &[]));
    // Names the format allows and XML does not, long ones, and a device without places.
    let odd = "net {<&\u{7}>}\npl {a=1,x=1} (1)\npl {\"quoted\" <and> a rather long name of a place} (1)\ntr t -> \ntr {u&v} {\"quoted\" <and> a rather long name of a place} ->\n";
    assert_diagram(&system(EVERY_INSTRUCTION, &[odd]));
}

/// Arithmetic on numbers of 8 bits, with a hazard, a jump and an element of an array.
fn wide() -> System {
    let sint = Type::named("SINT").unwrap();
    let mut index = variable("i", Role::Buffer, sint);
    index.bits = 1;
    let variables = vec![
        variable("x", Role::Input, sint),
        variable("a[0]", Role::Memory, sint),
        variable("a[1]", Role::Memory, sint),
        index,
    ];
    let element = Target::Element(Element { first: VarId(1), stride: 1, length: 2, index: VarId(3) });
    let x = Operand::Place(Target::Variable(VarId(0)));
    let combine =
        |function| Instruction::Combine { function, ty: sint, negated: false, operand: Operand::Place(element) };
    let code = vec![
        Instruction::Load { ty: sint, negated: false, operand: x },
        combine(Function::Add),
        combine(Function::Mul),
        combine(Function::Div),
        Instruction::Store { ty: sint, negated: false, target: element },
        combine(Function::Lt),
        Instruction::Jump { condition: Condition::IfTrue, target: 7 },
    ];
    System::new(flat(variables, code), Plant::default())
}

#[test]
fn wide_data_is_drawn_whole_and_legible() {
    let system = wide();
    assert_diagram(&system);
    for line in [0, 1, 4, 5, 6] {
        let shapes = assert_legible(&subnet(&system, line, None).svg());
        assert_eq!(shapes.boxes.len(), system.transitions_of(TransitionRole::Line(line)).count());
    }
}

#[test]
fn a_long_program_takes_space_and_time_in_proportion() {
    let program = |lines: usize| {
        let body: String = (0..lines).map(|i| format!("LD x{}\n", i % 7)).collect();
        system(&format!("PROGRAM p VAR x0, x1, x2, x3, x4, x5, x6 : BOOL; END_VAR\n{body}END_PROGRAM"), &[])
    };
    let [short, long] = [100, 2000].map(|lines| diagram(&program(lines)).svg().len());
    assert!(long < 21 * short, "{short} bytes for 100 lines, {long} for 2000");
}

#[test]
fn no_two_nodes_have_the_same_position() {
    for system in [system(TWO_HAND_SWITCH, &[HANDS]), system(EVERY_INSTRUCTION, &[CYLINDER]), wide()] {
        let positions = positions(&system);
        assert_eq!(positions.places.len(), system.net.places().len());
        assert_eq!(positions.transitions.len(), system.net.transitions().len());
        let mut all: Vec<_> = positions.places.into_iter().chain(positions.transitions).collect();
        all.sort_unstable();
        assert!(all.windows(2).all(|pair| pair[0] != pair[1]));
    }
}
