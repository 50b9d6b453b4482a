"""The tools' targets: for each tool its settings as a dataclass, and a function (optimizer, settings) -> Target. No
Blender.
"""
