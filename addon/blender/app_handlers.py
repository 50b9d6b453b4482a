"""Registration of functions with Blender's application handlers, and of what draws in 3D views."""
from collections.abc import Callable, Sequence

import bpy

Handlers = Sequence[tuple[str, Callable[..., None]]]  # name in bpy.app.handlers, function
Registration = tuple[Callable[[], None], Callable[[], None]]  # the functions that register and unregister


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


def listen(handlers: Handlers, forget: Callable[[], None] = lambda: None) -> Registration:
    """Makes the functions that register handlers, and that remove them and forget what they know."""
    def register() -> None:
        add_app_handlers(handlers)

    def unregister() -> None:
        remove_app_handlers(handlers)
        forget()

    return register, unregister


def forget_at_load(*clears: Callable[[], None]) -> Registration:
    """Makes the functions that register and unregister what a module knows of a file, which `clears` forget: before
    another file is read, and at last.
    """
    @bpy.app.handlers.persistent
    def forget(*_: object) -> None:
        for clear in clears:
            clear()

    return listen([("load_pre", forget)], forget)


def draw_in_views(draws: Sequence[tuple[Callable[[], None], str]], handlers: Handlers,
                  forget: Callable[[], None]) -> Registration:
    """Makes the functions that register what draws in all 3D views, each with its kind, and the handlers that note
    changes, and that end both. In the background nothing is drawn.
    """
    drawn: list = []

    def register() -> None:
        if not bpy.app.background:
            add_app_handlers(handlers)
            drawn.extend(bpy.types.SpaceView3D.draw_handler_add(draw, (), 'WINDOW', kind) for draw, kind in draws)

    def unregister() -> None:
        remove_app_handlers(handlers)
        while drawn:
            bpy.types.SpaceView3D.draw_handler_remove(drawn.pop(), 'WINDOW')
        forget()

    return register, unregister
