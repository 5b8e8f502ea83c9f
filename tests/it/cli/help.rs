//! Help: its examples are accepted by the parser.

use std::ffi::OsString;

use clap::CommandFactory;
use shadetrade::cli::{self, Arguments};

use super::{folder, run, said};

fn commands() -> Vec<String> {
    Arguments::command()
        .get_subcommands()
        .map(|command| command.get_name().to_owned())
        .collect()
}

fn help(line: &str) -> String {
    let output = run(folder().path(), line);
    assert_eq!(output.status.code(), Some(0), "{line}: {}", said(&output));
    assert!(output.stderr.is_empty(), "{line}");
    String::from_utf8(output.stdout).expect("help is UTF-8")
}

#[test]
fn every_command_has_a_description_and_examples_that_parse() {
    let pages = commands()
        .into_iter()
        .map(|command| format!("{command} --help"));
    for page in pages.chain(["--help".to_owned()]) {
        let text = help(&page);
        assert!(
            text.lines().next().is_some_and(|line| line.len() > 20),
            "{page} must begin with a description"
        );
        let examples: Vec<&str> = text
            .lines()
            .filter_map(|line| line.strip_prefix("  shadetrade"))
            .collect();
        assert!(!examples.is_empty(), "{page} has no example");
        for example in examples {
            // Two spaces separate an example from its explanation; the shell redirects output after >.
            let line = example
                .split("  ")
                .next()
                .unwrap()
                .split('>')
                .next()
                .unwrap();
            let words = std::iter::once("shadetrade").chain(line.split_whitespace());
            let parsed = cli::parse(words.map(OsString::from));
            assert!(
                matches!(parsed, Ok(Some(_))),
                "{page} has the example `shadetrade{example}`: {parsed:?}"
            );
        }
    }
}
