//! scratch
use petril::*;
fn main() {
    for f in std::env::args().skip(1) {
        let bytes = std::fs::read(&f).unwrap();
        let source = source::Source::decode(f, &bytes).unwrap();
        let (unit, diags) = syntax::parse(&source);
        println!("{unit}");
        for d in diags {
            print!("{}", diagnostic::render(&d, &source, Default::default()));
        }
    }
}
