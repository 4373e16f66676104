//! Sessions at the command line, in `tests/cli/*.md`. To write what is printed now into them: `TRYCMD=overwrite cargo test
//! --test cli`. Then read them.

#[test]
fn sessions_go_as_shown() {
    trycmd::TestCases::new().case("tests/cli/*.md").env("RUST_BACKTRACE", "0");
}
