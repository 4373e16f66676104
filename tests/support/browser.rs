//! A real browser without a window: Chromium, led by ChromeDriver.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

/// A browser with one page open.
pub struct Browser {
    driver: Child,
    session: String,
    /// What the browser keeps while it runs.
    _folder: tempfile::TempDir,
}

impl Browser {
    /// Starts the browser that `PETRIL_BROWSER` names; nothing if it names none.
    pub fn start() -> Option<Self> {
        let Some(browser) = std::env::var_os("PETRIL_BROWSER") else {
            eprintln!("PETRIL_BROWSER is not set: pages are not opened in a browser");
            return None;
        };
        let mut driver = Command::new("chromedriver")
            .arg("--port=0")
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("chromedriver can be started");
        let mut lines = BufReader::new(driver.stdout.take().unwrap()).lines();
        let port = loop {
            let line = lines.next().expect("chromedriver says its port").unwrap();
            if let Some((_, port)) = line.split_once("started successfully on port ") {
                break port.trim_end_matches('.').to_owned();
            }
        };
        // Nobody reads on, but the pipe must not fill.
        thread::spawn(move || lines.for_each(drop));
        let folder = tempfile::tempdir().unwrap();
        let arguments = [
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-quic",
            "--no-first-run",
            "--disable-background-networking",
            "--disable-component-update",
            "--disable-sync",
            &format!("--user-data-dir={}", folder.path().display()),
        ];
        let base = format!("http://127.0.0.1:{port}/session");
        let options = json!({ "binary": browser.to_str().unwrap(), "args": arguments });
        let capabilities = json!({
            "browserName": "chrome",
            "goog:loggingPrefs": { "browser": "ALL" },
            "goog:chromeOptions": options,
        });
        let session = send(&base, &json!({ "capabilities": { "alwaysMatch": capabilities } }));
        let session = format!("{base}/{}", session["sessionId"].as_str().unwrap());
        let browser = Self { driver, session, _folder: folder };
        browser.resize(1280, 900);
        Some(browser)
    }

    fn ask(&self, command: &str, body: &Value) -> Value {
        send(&format!("{}/{command}", self.session), body)
    }

    /// Opens a file.
    pub fn open(&self, file: &Path) {
        self.ask("url", &json!({ "url": format!("file://{}", file.display()) }));
    }

    /// What a piece of script returns.
    pub fn run(&self, script: &str) -> Value {
        self.ask("execute/sync", &json!({ "script": script, "args": [] }))
    }

    /// Waits until a condition of the page is true.
    pub fn wait_for(&self, condition: &str) {
        let started = Instant::now();
        while self.run(&format!("return Boolean({condition})")) != true {
            assert!(started.elapsed() < Duration::from_secs(10), "{condition} never comes");
            thread::sleep(Duration::from_millis(30));
        }
    }

    /// Clicks, as a hand would, on the first element a selector finds.
    pub fn click(&self, selector: &str) {
        let found = self.ask("element", &json!({ "using": "css selector", "value": selector }));
        let id = found.as_object().unwrap().values().next().unwrap().as_str().unwrap().to_owned();
        self.ask(&format!("element/{id}/click"), &json!({}));
    }

    /// Presses keys, one after the other; those of WebDriver's list by their code points.
    pub fn press(&self, keys: &[char]) {
        let actions = keys.iter().flat_map(|key| {
            let key = key.to_string();
            [json!({ "type": "keyDown", "value": key }), json!({ "type": "keyUp", "value": key })]
        });
        let actions: Vec<Value> = actions.collect();
        self.ask("actions", &json!({ "actions": [{ "type": "key", "id": "keyboard", "actions": actions }] }));
    }

    /// Makes the window as large as a screen.
    pub fn resize(&self, width: u32, height: u32) {
        let screen = json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 500 });
        self.devtools("Emulation.setDeviceMetricsOverride", &screen);
    }

    /// Sends a command of the browser's own protocol.
    pub fn devtools(&self, command: &str, parameters: &Value) -> Value {
        self.ask("goog/cdp/execute", &json!({ "cmd": command, "params": parameters }))
    }

    /// What the console of the page has said since it was asked last.
    pub fn console(&self) -> Vec<String> {
        let log = self.ask("se/log", &json!({ "type": "browser" }));
        log.as_array().unwrap().iter().map(|entry| entry["message"].to_string()).collect()
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        let _ = ureq::delete(&self.session).call();
        let _ = self.driver.kill();
        let _ = self.driver.wait();
    }
}

/// A command and its answer.
fn send(url: &str, body: &Value) -> Value {
    let agent = ureq::Agent::config_builder().http_status_as_error(false).build().new_agent();
    let mut answer: Value = agent.post(url).send_json(body).unwrap().body_mut().read_json().unwrap();
    let value = answer["value"].take();
    assert!(value.get("error").is_none(), "{url} {body}\n{value:#}");
    value
}
