//! The words of the command line in, one command with checked values out.
//!
//! Rule: where a person can have meant something else, the message says what.

use std::ffi::{OsStr, OsString};
use std::io::{self, ErrorKind, Write};
use std::path::Path;

use anyhow::anyhow;
use clap::error::ContextKind;
use clap::{CommandFactory, Parser};

use super::{Arguments, Command, Failure};
use crate::scene;

/// The command of a command line, or none where help or the version was asked for: that is printed already.
///
/// # Errors
/// When the command line is wrong, or help could not be printed.
pub fn parse(words: impl IntoIterator<Item = OsString>) -> Result<Option<Command>, Failure> {
    let mut words: Vec<OsString> = words.into_iter().collect();
    let asks_help = words.get(1).is_some_and(|word| word == "help");
    if asks_help && words.get(2).is_some_and(|word| is_flag(word)) {
        // To clap `help` has no options, not even this one.
        words.remove(1);
    }
    let named = words.get(if asks_help { 2 } else { 1 });
    if let Some(error) = named.and_then(|word| misspelt_command(word)) {
        return Err(Failure::of(&error, None));
    }
    match Arguments::try_parse_from(&words) {
        Ok(Arguments {
            command: Some(command),
            ..
        }) => Ok(Some(command)),
        Ok(Arguments {
            command: None,
            view,
        }) => match &view.drawing.scene {
            Some(scene) if is_command(scene.as_os_str()) => {
                let command = scene.to_string_lossy();
                Err(Failure::Usage(anyhow!(command_first(&command))))
            }
            _ => Ok(Some(Command::View(view))),
        },
        Err(error) if error.use_stderr() => Err(wrong(words, error)),
        Err(help) => match help.print().and_then(|()| io::stdout().flush()) {
            Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure::Work(
                anyhow::Error::from(error).context("cannot write to standard output"),
            )),
            _ => Ok(None),
        },
    }
}

/// What is wrong with a line that clap refuses for `error`.
fn wrong(mut words: Vec<OsString>, error: clap::Error) -> Failure {
    if words.get(1).is_none_or(|word| is_command(word)) {
        return Failure::of(&error, None);
    }
    let meant = words
        .iter()
        .skip(2)
        .find(|word| is_command(word))
        .map(|word| command_first(&word.to_string_lossy()));
    // Clap takes a second scene for a command; spelt out, the line is told what it is.
    words.insert(1, "view".into());
    Failure::of(
        &Arguments::try_parse_from(words).err().unwrap_or(error),
        meant,
    )
}

fn is_command(word: &OsStr) -> bool {
    // Clap adds `help` by itself, and only while parsing.
    word == "help"
        || Arguments::command()
            .get_subcommands()
            .any(|command| command.get_name() == word)
}

fn is_flag(word: &OsStr) -> bool {
    word.to_string_lossy().starts_with('-')
}

fn command_first(command: &str) -> String {
    format!(
        "a command comes first: `shadetrade {command} ...`; a scene file so named is ./{command}"
    )
}

/// Clap's error for a first word that resembles a command and can be no scene.
///
/// To clap alone a first word that is no command is a scene, so that `rendr` would be a missing file.
fn misspelt_command(word: &OsStr) -> Option<clap::Error> {
    let path = Path::new(word);
    let is_plain = path.components().count() == 1 && path.extension().is_none();
    if !is_plain || path.exists() || scene::is_built_in(path) {
        return None;
    }
    let error = clap::Command::new("shadetrade")
        .subcommands(Arguments::command().get_subcommands().cloned())
        .try_get_matches_from([OsStr::new("shadetrade"), word])
        .err()?;
    error
        .get(ContextKind::SuggestedSubcommand)
        .is_some()
        .then_some(error)
}
