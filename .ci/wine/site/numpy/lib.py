"""Where pybind11 looks for numpy's version."""


class NumpyVersion:
    def __init__(self, version: str) -> None:
        self.major = int(version.split(".")[0])
