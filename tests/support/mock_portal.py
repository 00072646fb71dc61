"""A desktop that answers questions for files as a test wants it: a template of python3-dbusmock.

Parameters (JSON): log: the file that gets a line of JSON per event; version; behavior: how it ends
(below); response: its code; results: its dictionary of URIs, as {"uris": [...]}.
"""

import json
import os

import dbus
import dbus.service
from gi.repository import GLib

import dbusmock

BUS_NAME = "org.freedesktop.portal.Desktop"
MAIN_OBJ = "/org/freedesktop/portal/desktop"
MAIN_IFACE = "org.freedesktop.portal.FileChooser"
SYSTEM_BUS = False
REQUEST = "org.freedesktop.portal.Request"


def note(log, **event):
    with open(log, "a", encoding="utf-8") as file:
        file.write(json.dumps(event) + "\n")


def plain(value):
    """A value of D-Bus in types of JSON; bytes as their numbers."""
    if isinstance(value, dict):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, dbus.Boolean):
        return bool(value)
    return int(value) if isinstance(value, int) else str(value)


def load(mock, parameters):
    mock.parameters = parameters
    if "version" in parameters:
        version = parameters["version"]
        value = dbus.UInt32(version) if isinstance(version, int) else version
        mock.AddProperty(MAIN_IFACE, "version", value)
    note(parameters["log"], event="ready", pid=os.getpid())


def respond(mock, path):
    results = mock.parameters.get("results", {})
    values = {key: dbus.Array(value, signature="s") if isinstance(value, list) else value
              for key, value in results.items()}
    code = dbus.UInt32(mock.parameters.get("response", 0))
    dbusmock.get_object(path).EmitSignal(REQUEST, "Response", "ua{sv}", [
        code, dbus.Dictionary(values, signature="sv")])


def ask(mock, method, arguments, sender, reply):
    parent, title, options = arguments
    log = mock.parameters["log"]
    note(log, event=method, parent=plain(parent), title=plain(title), options=plain(options))
    path = MAIN_OBJ + "/request/" + sender[1:].replace(".", "_") + "/"
    behavior = mock.parameters.get("behavior", "answer")
    path += "other" if behavior == "other handle" else str(options["handle_token"])
    close = "open(%r, 'a').write('{\"event\": \"Close\"}\\n')" % log
    mock.AddObject(path, REQUEST, {}, [("Close", "", "", close)])
    if behavior == "never reply":
        return
    if behavior == "early":
        respond(mock, path)
    reply(dbus.ObjectPath(path))
    if behavior in ("answer", "other handle"):
        GLib.idle_add(respond, mock, path)
    if behavior == "crash":
        GLib.timeout_add(50, os.abort)
    if behavior == "wrong types":
        dbusmock.get_object(path).EmitSignal(REQUEST, "Response", "s", ["what?"])
    if behavior == "wrong path":
        mock.AddObject(path + "x", REQUEST, {}, [])
        GLib.idle_add(respond, mock, path + "x")


@dbus.service.method(MAIN_IFACE, in_signature="ssa{sv}", out_signature="o",
                     sender_keyword="sender", async_callbacks=("reply", "fail"))
def OpenFile(self, parent, title, options, sender=None, reply=None, fail=None):
    if self.parameters.get("behavior") == "refuse":
        return fail(dbus.exceptions.DBusException("no display", name="org.test.NoDisplay"))
    return ask(self, "OpenFile", (parent, title, options), sender, reply)


@dbus.service.method(MAIN_IFACE, in_signature="ssa{sv}", out_signature="o",
                     sender_keyword="sender", async_callbacks=("reply", "fail"))
def SaveFile(self, parent, title, options, sender=None, reply=None, fail=None):
    del fail
    return ask(self, "SaveFile", (parent, title, options), sender, reply)
