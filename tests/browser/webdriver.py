# SPDX-License-Identifier: MIT
"""Chromium, driven by WebDriver (www.w3.org/TR/webdriver2): JSON over HTTP to Debian's chromedriver.

    with Browser() as browser:
        browser.resize(380, 900)
        browser.open("file:///tmp/page.html")
        browser.run("return document.title")
        browser.console(), browser.requests(), browser.dialogs
"""

import base64
import http.client
import json
import re
import subprocess
import tempfile
import time

FLAGS = ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run",
         "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-quic",
         "--remote-debugging-pipe"]  # Chromium 150, that of the release, does not always answer at a port of its own


class Refused(Exception):
    """What the driver says that it could not do; `dialog` is the text of one that was in the way."""

    def __init__(self, message, dialog=None):
        super().__init__(message)
        self.dialog = dialog


class Browser:
    def __init__(self, driver="chromedriver", chromium="/usr/bin/chromium"):
        self.dialogs = []  # the texts of those that the page has opened
        self._folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self._log = open(f"{self._folder.name}/driver.log", "w+", encoding="utf-8")
        self._driver = subprocess.Popen([driver, "--port=0"], stdout=subprocess.PIPE, stderr=self._log, text=True)
        self._session = None
        try:
            self._port = self._port_that_it_says()
            told = self._ask("POST", "/session", {"capabilities": {"alwaysMatch": {
                "browserName": "chrome",
                "unhandledPromptBehavior": "dismiss and notify",
                "goog:loggingPrefs": {"browser": "ALL", "performance": "ALL"},
                "goog:chromeOptions": {"binary": chromium,
                                       "args": [*FLAGS, f"--user-data-dir={self._folder.name}/profile"]}}}})
            self._session = told["sessionId"]
            self.open("about:blank")
            self.console(), self.requests()  # those of the page with which it starts
        except BaseException:
            self.close()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        try:
            if self._session:
                self._ask("DELETE", f"/session/{self._session}")
        finally:
            self._driver.terminate()
            self._driver.wait()
            self._driver.stdout.close()
            self._log.close()
            self._folder.cleanup()

    def open(self, url):
        """Opens a page, whose scripts have run afterwards; Chromium 150 does not always wait for them."""
        # Only the place in the page changes where the address has the same page and a fragment.
        self.run("const [page, ...place] = arguments[0].split('#');"
                 "window.isLeft = !place.length || page !== location.href.split('#')[0]", url)
        self._do("POST", "url", {"url": url})
        for _ in range(600):
            if self.run("return !window.isLeft && document.readyState === 'complete'"):
                return
            time.sleep(0.05)
        raise Refused(f"{url} is not loaded after 30 s")

    def resize(self, width, height, dark=False):
        """The window, in pixels, and whether a person has asked for dark pages; holds for pages opened after it."""
        self.protocol("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        self.show(dark)

    def show(self, dark=False, printed=False):
        """The colours that a person has asked for, or the page as it is printed."""
        self.protocol("Emulation.setEmulatedMedia", media="print" if printed else "",
                      features=[{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])

    def run(self, script, *arguments):
        """What a script returns; `arguments[0]` … are its arguments."""
        return self._do("POST", "execute/sync", {"script": script, "args": list(arguments)})

    def run_until_told(self, script, *arguments):
        """What a script gives to the function that is its last argument: never null, which Chromium 150 answers where a
        dialog opens meanwhile."""
        for _ in range(20):
            told = self._do("POST", "execute/async", {"script": script, "args": list(arguments)})
            if told is not None:
                return told
        raise Refused("a script of the page tells nothing")

    def click(self, selector):
        found = self._do("POST", "element", {"using": "css selector", "value": selector})
        self._do("POST", f"element/{next(iter(found.values()))}/click", {})

    def press(self, key):
        self._do("POST", "actions", {"actions": [{"type": "key", "id": "keyboard", "actions": [
            {"type": "keyDown", "value": key}, {"type": "keyUp", "value": key}]}]})

    def drag(self, start, places, release=True):
        """Presses the mouse at a place of the window and moves it to others."""
        moves = [{"type": "pointerMove", "duration": 20, "x": round(x), "y": round(y)} for x, y in places]
        actions = [{"type": "pointerMove", "duration": 0, "x": round(start[0]), "y": round(start[1])},
                   {"type": "pointerDown", "button": 0}, *moves]
        self._pointer(actions + [{"type": "pointerUp", "button": 0}] * release)

    def release(self):
        self._pointer([{"type": "pointerUp", "button": 0}])

    def _pointer(self, actions):
        self._do("POST", "actions", {"actions": [{"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"},
                                                  "actions": actions}]})

    def console(self):
        """The messages since the last call, errors of scripts among them."""
        return [entry["message"] for entry in self._do("POST", "se/log", {"type": "browser"})]

    def requests(self):
        """The addresses that pages have asked for since the last call."""
        events = [json.loads(entry["message"])["message"] for entry in self._do("POST", "se/log", {"type": "performance"})]
        return [event["params"]["request"]["url"] for event in events if event["method"] == "Network.requestWillBeSent"]

    def picture(self, file):
        """The whole page as a PNG."""
        data = self.protocol("Page.captureScreenshot", captureBeyondViewport=True)["data"]
        with open(file, "wb") as written:
            written.write(base64.b64decode(data))

    def protocol(self, command, **parameters):
        """A command of Chromium's own protocol, for what WebDriver does not have."""
        return self._do("POST", "goog/cdp/execute", {"cmd": command, "params": parameters})

    def _port_that_it_says(self):
        for line in self._driver.stdout:
            if said := re.search(r"started successfully on port (\d+)", line):
                return int(said[1])
        self._log.seek(0)
        raise Refused(f"chromedriver does not start: {self._log.read()}")

    def _do(self, method, what, body=None):
        """A command of the session; a dialog that is in the way is dismissed, and the command repeated."""
        for _ in range(20):
            try:
                return self._ask(method, f"/session/{self._session}/{what}", body)
            except Refused as refused:
                if refused.dialog is None:
                    raise
                self.dialogs.append(refused.dialog)
        raise Refused("the page opens one dialog after the other")

    def _ask(self, method, path, body=None):
        connection = http.client.HTTPConnection("127.0.0.1", self._port)
        connection.request(method, path, None if body is None else json.dumps(body), {"Content-Type": "application/json"})
        answer = connection.getresponse()
        value = json.loads(answer.read())["value"]
        connection.close()
        if answer.status != 200:
            raise Refused(f"{value['error']}: {value['message']}", value.get("data", {}).get("text"))
        return value
