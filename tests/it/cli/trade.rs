//! `trade --methods`.

use std::fs;

use serde_json::Value;

use super::{folder, said, shadetrade};

#[test]
fn only_the_named_methods_are_measured_and_the_command_can_be_repeated() {
    let folder = folder();
    let output = shadetrade(folder.path())
        .args(["trade", "--quick", "--size", "24x18", "-o", "my report"])
        .args([
            "--methods",
            "phong-0.5,gouraud-0",
            "--lights",
            "white,ambient",
        ])
        .output()
        .expect("it starts");
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let out = folder.path().join("my report");
    let text = fs::read_to_string(out.join("trade.json")).expect("it can be read");
    let value: Value = serde_json::from_str(&text).expect("it is JSON");
    let methods = value["methods"].as_array().expect("there are methods");
    let ids: Vec<_> = methods.iter().map(|method| &method["id"]).collect();
    assert_eq!(ids, ["gouraud-0", "phong-0.5"]);
    let table = String::from_utf8(output.stdout).expect("a table is UTF-8");
    assert!(!table.contains("phong-0.25"), "{table}");
    assert!(!out.join("error-phong-0.png").exists());

    #[cfg(unix)]
    {
        let command = value["command"].as_str().expect("it is text");
        let script = format!("shadetrade() {{ printf '%s\\n' \"$@\"; }}; {command}");
        let words = String::from_utf8(crate::cli::in_shell(folder.path(), &script).stdout);
        let words = words.expect("it is UTF-8");
        let words: Vec<&str> = words.lines().collect();
        assert_eq!(words[5..7], ["my report", "--methods"], "{command}");
    }
}
