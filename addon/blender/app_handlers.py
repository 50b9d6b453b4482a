"""Registration of functions with Blender's application handlers."""
from collections.abc import Callable, Sequence

import bpy

Handlers = Sequence[tuple[str, Callable[..., None]]]  # name in bpy.app.handlers, function


def add_app_handlers(handlers: Handlers) -> None:
    """Registers the functions, each behind those that are there."""
    for name, function in handlers:
        getattr(bpy.app.handlers, name).append(function)


def remove_app_handlers(handlers: Handlers) -> None:
    """Removes the functions; those that are not registered, as in the background, are passed over."""
    for name, function in handlers:
        registered = getattr(bpy.app.handlers, name)
        if function in registered:
            registered.remove(function)


def forget_at_load(forget: Callable[..., None]) -> tuple[Callable[[], None], Callable[[], None]]:
    """Makes the functions that register and unregister what a module knows of a file, which `forget` clears, persistent
    as a handler: before another file is read, and at last.
    """
    def register() -> None:
        bpy.app.handlers.load_pre.append(forget)

    def unregister() -> None:
        bpy.app.handlers.load_pre.remove(forget)
        forget()

    return register, unregister
