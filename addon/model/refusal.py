"""The exception of requests that cannot be met: nothing has been changed, and operators report its sentence."""


class Refusal(Exception):
    """One sentence for the user: what, how many, what to do."""
