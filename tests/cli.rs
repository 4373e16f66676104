//! Sessions at the command line, in `tests/cli/*.md` and in the guide. To write what is printed now into them:
//! `TRYCMD=overwrite cargo test --test cli`. Then read them. (The guide leaves parts out; put its `...` back.)

#[test]
fn sessions_go_as_shown() {
    trycmd::TestCases::new().case("tests/cli/*.md").case("docs/requirements.md").env("RUST_BACKTRACE", "0");
}
