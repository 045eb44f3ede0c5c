"""A browser driven over the W3C WebDriver protocol, with what Python has."""

import base64
import json
import re
import shutil
import subprocess
import tempfile
import time
import urllib.error
import urllib.request

ELEMENT = "element-6066-11e4-a52e-4f735466cecf"  # the key that the protocol gives elements
SWITCHES = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--hide-scrollbars",
            "--disable-background-networking", "--disable-component-update", "--disable-sync"]


def browser():
    """The paths of Chromium and ChromeDriver, or None where one is missing."""
    paths = shutil.which("chromium"), shutil.which("chromedriver")
    return paths if all(paths) else None


class Browser:
    def __init__(self, chromium, driver):
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.driver = subprocess.Popen([driver, "--port=0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        for line in self.driver.stdout:
            if started := re.search(r"started successfully on port (\d+)", line):
                break
        else:
            raise RuntimeError("chromedriver did not start")
        self.root = f"http://127.0.0.1:{started[1]}"
        options = {"binary": chromium, "args": SWITCHES + [f"--user-data-dir={self.profile.name}"]}
        wanted = {"browserName": "chrome", "goog:chromeOptions": options, "goog:loggingPrefs": {"browser": "ALL"}}
        self.session = ""
        self.session = "/session/" + self._call("POST", "/session", {"capabilities": {"alwaysMatch": wanted}})["sessionId"]

    def close(self):
        try:
            self._call("DELETE", "")
        finally:
            self.driver.terminate()
            self.driver.wait()
            self.driver.stdout.close()
            self.profile.cleanup()

    def _call(self, method, path, body=None):
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.root + self.session + path, data, {"Content-Type": "application/json"},
                                         method=method)
        try:
            with urllib.request.urlopen(request, timeout=120) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(json.load(error)["value"]["message"].splitlines()[0]) from None

    def open(self, path):
        self._call("POST", "/url", {"url": path.resolve().as_uri()})

    def run(self, script, *args):
        """The value of `script`, the body of a function."""
        return self._call("POST", "/execute/sync", {"script": script, "args": list(args)})

    def find(self, selector):
        return self._call("POST", "/element", {"using": "css selector", "value": selector})[ELEMENT]

    def click(self, selector):
        self._call("POST", f"/element/{self.find(selector)}/click", {})

    def text(self, selector):
        return self._call("GET", f"/element/{self.find(selector)}/text")

    def wait(self, expression, seconds=30):
        """Until a JavaScript expression is true."""
        until = time.monotonic() + seconds
        while not self.run(f"return {expression}"):
            if time.monotonic() > until:
                raise AssertionError(f"still not true after {seconds} s: {expression}")
            time.sleep(0.02)

    def size(self, width, height, phone=False):
        self._cdp("Emulation.setDeviceMetricsOverride",
                  {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": phone})

    def dark(self, on):
        value = "dark" if on else "light"
        self._cdp("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": value}]})

    def _cdp(self, command, params):
        self._call("POST", "/goog/cdp/execute", {"cmd": command, "params": params})

    def move(self, x, y):
        """The mouse, to a place in the window."""
        self._act("pointer", {"type": "pointerMove", "duration": 0, "x": round(x), "y": round(y)})

    def wheel(self, x, y, delta):
        self._act("wheel", {"type": "scroll", "duration": 0, "x": round(x), "y": round(y), "deltaX": 0, "deltaY": delta})

    def _act(self, kind, action):
        source = {"type": kind, "id": kind, "actions": [action]}
        if kind == "pointer":
            source["parameters"] = {"pointerType": "mouse"}
        self._call("POST", "/actions", {"actions": [source]})

    def complaints(self):
        """What the console got since the last call."""
        return [entry["message"] for entry in self._call("POST", "/se/log", {"type": "browser"})]

    def save_screenshot(self, path):
        path.write_bytes(base64.b64decode(self._call("GET", "/screenshot")))
