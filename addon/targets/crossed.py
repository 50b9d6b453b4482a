"""The target of the lines that cross those of a tool."""
from .. import native
from ..native_call import call


async def build_kept_target(optimizer: "native.ShapeOptimizer") -> "native.Target":
    """Builds the target of the crossed lines as they are, which are kept as far as the wanted ones allow."""
    return await call(native.reflines.keep, optimizer, family=1)
