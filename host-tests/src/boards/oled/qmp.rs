//! A client of QEMU's machine protocol: a line of JSON a message, over the loopback.
//!
//! `serde_json` reads the lines: file names are escaped and keys come in any order, so a search in
//! the text would not do. A typed client (crate `qapi`) is a wrapper of every command of QEMU's,
//! of which five are used here.

use serde_json::{Value, json};
use std::collections::VecDeque;
use std::io::{BufRead, BufReader, ErrorKind, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::time::{Duration, Instant};

/// A connection that is given up at a deadline.
#[derive(Debug)]
pub struct Qmp {
    stream: BufReader<TcpStream>,
    deadline: Instant,
    /// Events that came while an answer was waited for.
    events: VecDeque<String>,
}

/// A socket for QEMU to connect to, at a port that is free.
///
/// # Errors
///
/// What the system says.
pub fn listen() -> Result<TcpListener, String> {
    TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).map_err(|error| error.to_string())
}

/// How often a connection is looked for.
const POLL: Duration = Duration::from_millis(5);

impl Qmp {
    /// Waits for QEMU to connect, and starts the session.
    ///
    /// # Errors
    ///
    /// What `has_failed` says where it says something; at the deadline; or what the socket says.
    pub fn accept(
        listener: &TcpListener,
        deadline: Instant,
        mut has_failed: impl FnMut() -> Option<String>,
    ) -> Result<Self, String> {
        listener.set_nonblocking(true).map_err(|error| error.to_string())?;
        let stream = loop {
            match listener.accept() {
                Ok((stream, _)) => break stream,
                Err(error) if error.kind() != ErrorKind::WouldBlock => {
                    return Err(error.to_string());
                }
                Err(_) => {}
            }
            if let Some(failure) = has_failed() {
                return Err(failure);
            }
            if Instant::now() > deadline {
                return Err("it did not connect in time".to_owned());
            }
            std::thread::sleep(POLL);
        };
        stream.set_nonblocking(false).map_err(|error| error.to_string())?;
        let mut qmp = Self { stream: BufReader::new(stream), deadline, events: VecDeque::new() };
        let greeting = qmp.message()?;
        if greeting.get("QMP").is_none() {
            return Err(format!("it greets with {greeting}"));
        }
        qmp.execute("qmp_capabilities", &json!({}))?;
        Ok(qmp)
    }

    /// Has a command done.
    ///
    /// # Errors
    ///
    /// QEMU's answer where it is an error; at the deadline; or what the socket says.
    pub fn execute(&mut self, command: &str, arguments: &Value) -> Result<(), String> {
        let line = json!({ "execute": command, "arguments": arguments }).to_string() + "\n";
        self.stream.get_mut().write_all(line.as_bytes()).map_err(|error| error.to_string())?;
        loop {
            let message = self.message()?;
            if let Some(error) = message.get("error") {
                return Err(format!("{command}: {error}"));
            }
            if message.get("return").is_some() {
                return Ok(());
            }
            self.events.extend(event(&message));
        }
    }

    /// Ends QEMU, which may close the connection before it answers.
    ///
    /// # Errors
    ///
    /// What the socket says where it cannot be asked.
    pub fn quit(mut self) -> Result<(), String> {
        let line = json!({ "execute": "quit" }).to_string() + "\n";
        self.stream.get_mut().write_all(line.as_bytes()).map_err(|error| error.to_string())
    }

    /// Waits for an event.
    ///
    /// # Errors
    ///
    /// At the deadline, or what the socket says.
    pub fn wait_for(&mut self, wanted: &str) -> Result<(), String> {
        loop {
            while let Some(event) = self.events.pop_front() {
                if event == wanted {
                    return Ok(());
                }
            }
            let message = self.message().map_err(|error| format!("no {wanted}: {error}"))?;
            self.events.extend(event(&message));
        }
    }

    /// The next message.
    fn message(&mut self) -> Result<Value, String> {
        let left = self.deadline.saturating_duration_since(Instant::now());
        // A timeout of 0 is none.
        let left = left.max(Duration::from_millis(1));
        self.stream.get_ref().set_read_timeout(Some(left)).map_err(|error| error.to_string())?;
        let mut line = String::new();
        match self.stream.read_line(&mut line) {
            Ok(0) => Err("it closed the connection".to_owned()),
            Ok(_) => serde_json::from_str(&line).map_err(|error| format!("{line}: {error}")),
            Err(error) if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {
                Err("it did not answer in time".to_owned())
            }
            Err(error) => Err(error.to_string()),
        }
    }
}

/// The name of an event.
fn event(message: &Value) -> Option<String> {
    message.get("event")?.as_str().map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::thread::{self, JoinHandle};

    /// A socket, and a QEMU that says these lines, one after each line that it gets but the first,
    /// which is said unasked. It returns what it got.
    fn played(says: &'static [&str]) -> (TcpListener, JoinHandle<Vec<String>>) {
        let listener = listen().unwrap();
        let address = listener.local_addr().unwrap();
        let qemu = thread::spawn(move || {
            let mut stream = BufReader::new(TcpStream::connect(address).unwrap());
            let mut got = Vec::new();
            for (at, line) in says.iter().enumerate() {
                if at > 0 {
                    let mut text = String::new();
                    stream.read_line(&mut text).unwrap();
                    got.push(text);
                }
                stream.get_mut().write_all(line.as_bytes()).unwrap();
            }
            got
        });
        (listener, qemu)
    }

    fn accept(listener: &TcpListener, millis: u64) -> Result<Qmp, String> {
        Qmp::accept(listener, Instant::now() + Duration::from_millis(millis), || None)
    }

    #[test]
    fn events_are_kept_while_an_answer_is_waited_for() {
        let (listener, qemu) = played(&[
            "{\"QMP\": {}}\n",
            "{\"return\": {}}\n",
            "{\"event\": \"RESUME\"}\n{\"event\": \"STOP\"}\n{\"return\": {}}\n",
            "{\"error\": {\"desc\": \"no\"}}\n",
        ]);
        let mut qmp = accept(&listener, 5000).unwrap();
        qmp.execute("cont", &json!({})).unwrap();
        qmp.wait_for("STOP").unwrap();
        let error = qmp.execute("screendump", &json!({ "filename": "a \"b\"" })).unwrap_err();
        assert_eq!(error, "screendump: {\"desc\":\"no\"}");
        assert!(qmp.wait_for("STOP").unwrap_err().starts_with("no STOP: it closed"));
        let got = qemu.join().unwrap();
        let sent: Value = serde_json::from_str(&got[2]).unwrap();
        assert_eq!(
            sent,
            json!({ "execute": "screendump", "arguments": { "filename": "a \"b\"" } })
        );
    }

    #[test]
    fn silence_and_strangers_are_errors() {
        let (listener, qemu) = played(&["{\"hello\": 1}\n"]);
        assert_eq!(accept(&listener, 5000).unwrap_err(), "it greets with {\"hello\":1}");
        qemu.join().unwrap();
        let listener = listen().unwrap();
        assert_eq!(accept(&listener, 1).unwrap_err(), "it did not connect in time");
        let failed = || Some("it is gone".to_owned());
        let error = Qmp::accept(&listener, Instant::now(), failed).unwrap_err();
        assert_eq!(error, "it is gone");
        let silent = TcpStream::connect(listener.local_addr().unwrap()).unwrap();
        assert_eq!(accept(&listener, 50).unwrap_err(), "it did not answer in time");
        drop(silent);
    }
}
