//! Sessions at the command line, in `tests/cli/*.md` and in the guides. To write what is printed now into them:
//! `TRYCMD=overwrite cargo test --test command_line cli`. Then read them. (The guides leave parts out; put their `...` and `[..]` back.)

#[test]
fn sessions_go_as_shown() {
    trycmd::TestCases::new()
        .case("tests/cli/*.md")
        .case("README.md")
        .case("docs/requirements.md")
        .case("docs/safety-functions.md")
        .case("docs/examples.md")
        .case("docs/nets.md")
        .case("docs/simulation.md")
        .env("RUST_BACKTRACE", "0")
        .env("PETRIL_PROGRESS", "0")
        .env("LC_ALL", "C.UTF-8");
}
