//! When the picture changes and what is found out about it -> what is known of the picture as it is now.
//!
//! Rule: nothing is known of a picture but what was found out about that very picture, and nothing is asked before the
//! picture has rested for [`REST`].

use std::time::Duration;

use super::examiner::{Answer, Findings};

/// How long nothing changes before a picture is examined.
pub const REST: Duration = Duration::from_millis(100);

/// What is known of the present picture, and what was asked.
#[derive(Debug, Default)]
pub struct Examination {
    revision: u64,
    changed: Duration,
    asked: bool,
    findings: Option<Findings>,
}

impl Examination {
    /// The number of the present picture: every change makes it larger.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// What was found out about the present picture.
    pub fn findings(&self) -> Option<&Findings> {
        self.findings.as_ref()
    }

    /// The picture is another one from the time `now` on.
    pub fn restart(&mut self, now: Duration) {
        self.revision += 1;
        self.changed = now;
        self.asked = false;
        self.findings = None;
    }

    /// Whether to ask at the time `now`; says so once for every picture.
    pub fn is_due(&mut self, now: Duration) -> bool {
        let due = !self.asked && now >= self.changed + REST;
        self.asked |= due;
        due
    }

    /// Takes an answer; returns whether it is about the present picture.
    pub fn answer(&mut self, answer: Answer) -> bool {
        match (answer, &mut self.findings) {
            (Answer::Findings(findings), known) if findings.revision == self.revision => {
                *known = Some(findings);
            }
            (Answer::Proof(revision, proof), Some(findings)) if revision == self.revision => {
                findings.add_proof(proof);
            }
            _ => return false,
        }
        true
    }
}
