//! scratch
use petril::explore::*;
use petril::net::*;
use petril::*;
fn main() {
    for f in std::env::args().skip(1) {
        let bytes = std::fs::read(&f).unwrap();
        let source = source::Source::decode(f, &bytes).unwrap();
        let (unit, mut diags) = syntax::parse(&source);
        let (program, more) = semantics::check(&unit, !diagnostic::any_error(&diags));
        diags.extend(more);
        for d in diags {
            print!("{}", diagnostic::render(&d, &source, Default::default()));
        }
        let Some(program) = program else { continue };
        let flat = flat::flatten(&program);
        print!("{}", flat.listing(&source));
        for with in [true, false] {
            let mut plant = translate::Plant::default();
            let mut b = Builder::new("hands");
            for i in 1..=2 {
                let r = b.place(format!("S{i}=0,O{i}=1"), true);
                let p = b.place(format!("S{i}=1,O{i}=0"), false);
                b.transition(format!("press{i}"), Arcs { consume: vec![r], produce: vec![p], read: vec![] });
                b.transition(format!("release{i}"), Arcs { consume: vec![p], produce: vec![r], read: vec![] });
            }
            let net = b.build();
            let n = net.places().len();
            let t = net.transitions().len();
            if with {
                plant
                    .add(
                        &Located { net, places: vec![Default::default(); n], transitions: vec![Default::default(); t] },
                        &flat,
                    )
                    .unwrap();
            }
            let system = translate::System::new(flat.clone(), plant);
            for part in translate::Part::ALL {
                println!("{} {:?}", part.name(), system.size(part));
            }
            let g = explore(&MarkingSpace::new(&system.net), Budget::default(), &mut |_| None);
            println!("markings {} steps {} {:?}", g.len(), g.steps(), g.stop());
            let g = explore(&ScanSpace::new(&system), Budget::default(), &mut |_| None);
            println!("scan states {} steps {} depth {} {:?}", g.len(), g.steps(), g.depth() + 1, g.stop());
        }
    }
}
