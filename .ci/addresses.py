"""Addresses of the project on the web, which stand in one place, the table [project.urls] of pyproject.toml.

All that ships takes them from there: the manifest of the extension, and with it the repository's listing (`website`),
bl_info of the add-on (Blender's and the add-on's buttons in the preferences), and the metadata of wheels. What is not
in the table is written nowhere. A bad address stops the packing with a sentence.
"""
import re
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
NAMES = ("Homepage", "Documentation", "Issues")
LONGEST = 200  # characters
HOST = r"(?:[A-Za-z0-9](?:[A-Za-z0-9-]*[A-Za-z0-9])?\.)+[A-Za-z]{2,}(?::[0-9]{1,5})?"
# Only what may stand in an address, and no quote, so that TOML, Python and HTML take it as it is.
ADDRESS = re.compile(rf"https://{HOST}(?:[/?#][A-Za-z0-9._~:/?#\[\]@!$&()*+,;=%-]*)?")


def find_fault(name: str, address: object) -> str:
    """Returns why an entry of the table cannot be used; empty where it can."""
    if name not in NAMES:
        return f"the name is none of {', '.join(NAMES)}"
    if not isinstance(address, str):
        return "the address is no text"
    if len(address) > LONGEST:
        return f"the address has {len(address)} characters, more than {LONGEST}"
    if not ADDRESS.fullmatch(address):
        return f"{ascii(address)} is not of the form https://HOST/PATH, without spaces, quotes and letters beyond ASCII"
    return ""


def read_addresses() -> dict[str, str]:
    """Returns the project's addresses by their names; ends the program with a sentence where one is bad."""
    table = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"].get("urls", {})
    if not isinstance(table, dict):
        sys.exit("pyproject.toml: [project.urls] is no table of names and addresses.")
    for name, address in table.items():
        fault = find_fault(name, address)
        if fault:
            sys.exit(f"pyproject.toml, [project.urls], {ascii(name)}: {fault}.")
    return table


def manifest_lines() -> str:
    """Returns the lines of an extension's manifest; Blender knows only one address there, and refuses an empty one."""
    addresses = read_addresses()
    return f'website = "{addresses["Homepage"]}"\n' if "Homepage" in addresses else ""


def metadata_lines() -> list[str]:
    """Returns the lines of a wheel's metadata."""
    return [f"Project-URL: {name}, {address}" for name, address in read_addresses().items()]


def add_to_bl_info(source: str) -> str:
    """Returns the source of the add-on's __init__.py with the addresses in its bl_info.

    Blender reads doc_url and tracker_url; website is the add-on's own, for its preferences."""
    addresses = read_addresses()
    keys = {"website": addresses.get("Homepage"), "tracker_url": addresses.get("Issues"),
            "doc_url": addresses.get("Documentation", addresses.get("Homepage"))}
    rows = "".join(f'    "{key}": "{address}",\n' for key, address in keys.items() if address)
    head, tail = source.split("\n}\n", maxsplit=1)  # the first brace that ends in the first column is that of bl_info
    return f"{head}\n{rows}}}\n{tail}"
