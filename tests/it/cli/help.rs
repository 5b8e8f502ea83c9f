//! Help: its examples are accepted by the parser.

use std::ffi::OsString;
use std::path::Path;

use clap::CommandFactory;
use shadetrade::cli::{self, Arguments};

use super::{folder, run, said, shadetrade};

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

#[test]
fn the_options_of_view_work_without_its_name() {
    for line in [
        "bench-far --size 800x600",
        "--size 800x600 bench-far",
        "./render",
        "--camera 2 --lights none",
    ] {
        let parse = |line: String| {
            let words = line
                .split_whitespace()
                .map(OsString::from)
                .collect::<Vec<_>>();
            format!("{:?}", cli::parse(words).expect("a right command line"))
        };
        assert_eq!(
            parse(format!("shadetrade {line}")),
            parse(format!("shadetrade view {line}"))
        );
    }
}

#[test]
#[cfg(target_os = "linux")]
fn help_that_cannot_be_written_is_an_error_unless_the_reader_closed_it() {
    use std::fs::OpenOptions;
    use std::process::Stdio;

    for line in ["--help", "completions bash"] {
        let full = || Stdio::from(OpenOptions::new().write(true).open("/dev/full").unwrap());
        let output = shadetrade(Path::new("/"))
            .args(line.split(' '))
            .stdout(full())
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(1), "{line}");
        assert!(
            said(&output).contains("standard output"),
            "{line}: {}",
            said(&output)
        );

        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let output = shadetrade(Path::new("/"))
            .args(line.split(' '))
            .stdout(writer)
            .output()
            .unwrap();
        assert_eq!(
            (output.status.code(), said(&output).as_str()),
            (Some(0), ""),
            "{line}"
        );

        let status = shadetrade(Path::new("/"))
            .arg("--bogus")
            .stderr(full())
            .status()
            .unwrap();
        assert_eq!(
            status.code(),
            Some(2),
            "the status does not depend on standard error"
        );
    }
}
