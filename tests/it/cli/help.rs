//! The examples of the help are accepted by the parser.

use std::ffi::OsString;

use clap::CommandFactory;
use shadetrade::cli::{self, Arguments};

#[test]
fn every_command_has_examples_that_parse() {
    let mut program = Arguments::command();
    program.build();
    let pages = [program.clone()];
    for page in pages.iter().chain(program.get_subcommands()) {
        let name = page.get_name();
        if name == "help" {
            continue;
        }
        let help = page.clone().render_long_help().to_string();
        let examples = help
            .lines()
            .filter_map(|it| it.strip_prefix("  shadetrade"));
        // Two spaces separate an example from its explanation; the shell redirects output after >.
        let lines = examples.map(|it| it.split("  ").next().and_then(|it| it.split('>').next()));
        let lines: Vec<&str> = lines.flatten().collect();
        assert!(!lines.is_empty(), "{name} has no example");
        for line in lines {
            let words = std::iter::once("shadetrade").chain(line.split_whitespace());
            let parsed = cli::parse(words.map(OsString::from));
            assert!(matches!(parsed, Ok(Some(_))), "{line}: {parsed:?}");
        }
    }
}
