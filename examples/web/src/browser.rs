//! Chromium without a window, driven by the protocol of its developer tools.

use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::{Duration, Instant};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

/// Time for one answer of the browser, on a machine that is busy with other work.
const LIMIT: Duration = Duration::from_secs(120);

/// Time between two looks at a page that is to change.
const PAUSE: Duration = Duration::from_millis(20);

/// The browser reads commands on file 3 and answers on file 4, which the shell makes of its own input and output.
const SHELL: &str = r#"exec "$@" 3<&0 4>&1 0</dev/null 1>&2"#;

/// A browser with one page.
pub struct Browser {
    child: Child,
    commands: ChildStdin,
    messages: Receiver<Value>,
    commands_sent: u64,
    session: Option<String>,
    /// What went wrong in the page, and what it asked the network for.
    pub exceptions: Vec<String>,
    pub requests: Vec<String>,
}

impl Browser {
    /// Starts Chromium with an empty page; `folder` keeps its files.
    pub fn start(program: &str, folder: &Path) -> Result<Self, String> {
        let profile = format!("--user-data-dir={}", folder.display());
        let mut command = Command::new("sh");
        command.args(["-c", SHELL, "sh", program, "--headless=new", "--remote-debugging-pipe", &profile]);
        // In a container there is no other user to protect, and little shared memory.
        command.args(["--no-sandbox", "--disable-dev-shm-usage", "--disable-gpu", "--no-first-run"]);
        command.args(["--disable-background-networking", "--hide-scrollbars"]);
        let spawned = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null()).spawn();
        let mut child = spawned.map_err(|error| format!("cannot start {program}: {error}"))?;
        let (Some(commands), Some(answers)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(format!("{program} has no pipes"));
        };
        let (sender, messages) = channel();
        thread::spawn(move || {
            let mut answers = BufReader::new(answers);
            let mut message = Vec::new();
            while answers.read_until(0, &mut message).is_ok_and(|length| length > 0) {
                message.pop();
                if serde_json::from_slice(&message).is_ok_and(|value| sender.send(value).is_err()) {
                    break;
                }
                message.clear();
            }
        });
        let mut browser = Self {
            child,
            commands,
            messages,
            commands_sent: 0,
            session: None,
            exceptions: Vec::new(),
            requests: Vec::new(),
        };
        let target = browser.call("Target.createTarget", json!({ "url": "about:blank" }))?;
        let attached = json!({ "targetId": target["targetId"], "flatten": true });
        let session = browser.call("Target.attachToTarget", attached)?;
        browser.session = session["sessionId"].as_str().map(String::from);
        for domain in ["Page.enable", "Runtime.enable", "Network.enable"] {
            browser.call(domain, json!({}))?;
        }
        Ok(browser)
    }

    /// Calls a method of the browser and waits for its answer.
    pub fn call(&mut self, method: &str, parameters: Value) -> Result<Value, String> {
        self.commands_sent += 1;
        let id = self.commands_sent;
        let mut message = json!({ "id": id, "method": method, "params": parameters });
        if let Some(session) = &self.session {
            message["sessionId"] = json!(session);
        }
        let sent = self.commands.write_all(format!("{message}\0").as_bytes()).and_then(|()| self.commands.flush());
        sent.map_err(|error| format!("the browser has ended: {error}"))?;
        let deadline = Instant::now() + LIMIT;
        loop {
            let left = deadline.saturating_duration_since(Instant::now());
            let message = self.messages.recv_timeout(left);
            let message = message.map_err(|_| format!("{method}: the browser does not answer"))?;
            if message["id"] == json!(id) {
                return match message.get("error") {
                    Some(error) => Err(format!("{method}: {error}")),
                    None => Ok(message["result"].clone()),
                };
            }
            self.note(&message);
        }
    }

    /// Keeps what an event says that matters here.
    fn note(&mut self, event: &Value) {
        let parameters = &event["params"];
        match event["method"].as_str() {
            Some("Runtime.exceptionThrown") => {
                let details = &parameters["exceptionDetails"];
                let text = details["exception"]["description"].as_str().or(details["text"].as_str());
                self.exceptions.push(text.unwrap_or("an exception").to_owned());
            }
            Some("Network.requestWillBeSent") => {
                self.requests.push(parameters["request"]["url"].as_str().unwrap_or_default().to_owned());
            }
            _ => {}
        }
    }

    /// Opens a page in a window of this width and height, in a light or dark scheme.
    pub fn open(&mut self, file: &Path, (width, height): (u32, u32), scheme: &str) -> Result<(), String> {
        let size = json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 500 });
        self.call("Emulation.setDeviceMetricsOverride", size)?;
        let features = json!({ "features": [{ "name": "prefers-color-scheme", "value": scheme }] });
        self.call("Emulation.setEmulatedMedia", features)?;
        self.call("Page.navigate", json!({ "url": format!("file://{}", file.display()) }))?;
        self.wait_for("document.readyState === 'complete' && location.protocol === 'file:'")
    }

    /// The value of an expression in the page; a promise is awaited.
    pub fn value(&mut self, expression: &str) -> Result<Value, String> {
        let parameters = json!({ "expression": expression, "awaitPromise": true, "returnByValue": true });
        let answer = self.call("Runtime.evaluate", parameters)?;
        match answer.get("exceptionDetails") {
            Some(details) => Err(format!("{expression}: {details}")),
            None => Ok(answer["result"]["value"].clone()),
        }
    }

    /// The text that an expression gives.
    pub fn text(&mut self, expression: &str) -> Result<String, String> {
        let value = self.value(expression)?;
        value.as_str().map(String::from).ok_or_else(|| format!("{expression} is no text but {value}"))
    }

    /// Waits until an expression is true.
    pub fn wait_for(&mut self, expression: &str) -> Result<(), String> {
        let deadline = Instant::now() + LIMIT;
        while Instant::now() < deadline {
            if self.value(expression)? == json!(true) {
                return Ok(());
            }
            thread::sleep(PAUSE);
        }
        Err(format!("the page never satisfies {expression}"))
    }

    /// Presses a key, which has this name and code.
    pub fn press(&mut self, key: &str, code: u32) -> Result<(), String> {
        for kind in ["rawKeyDown", "keyUp"] {
            let event = json!({ "type": kind, "key": key, "code": key, "windowsVirtualKeyCode": code });
            self.call("Input.dispatchKeyEvent", event)?;
        }
        Ok(())
    }

    /// Writes a picture of the whole page, or of what the window shows of it.
    pub fn screenshot(&mut self, file: &Path, whole: bool) -> Result<(), String> {
        let answer = self.call("Page.captureScreenshot", json!({ "captureBeyondViewport": whole }))?;
        let picture = STANDARD.decode(answer["data"].as_str().unwrap_or_default());
        let picture = picture.map_err(|error| format!("screenshot: {error}"))?;
        fs::write(file, picture).map_err(|error| format!("{}: {error}", file.display()))
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
