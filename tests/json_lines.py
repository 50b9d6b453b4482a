"""JSON with one line for each record, so that a change shows which record it is."""
import json


def dump(value: object, indent: str = "") -> str:
    """Returns a container of containers with a line for each, anything else as one line."""
    items = list(value.values()) if isinstance(value, dict) else value
    if not isinstance(value, dict | list) or not any(isinstance(each, dict | list) for each in items):
        return json.dumps(value)
    keys = [f"{json.dumps(key)}: " for key in value] if isinstance(value, dict) else [""] * len(value)
    lines = [f"{indent} {key}{dump(each, indent + ' ')}" for key, each in zip(keys, items, strict=True)]
    start, end = "{}" if isinstance(value, dict) else "[]"
    return f"{start}\n" + ",\n".join(lines) + f"\n{indent}{end}"
