"""A request that cannot be met; nothing has been changed. Operators report it as it is."""


class Refusal(Exception):
    """One sentence for the user: what, how many, what to do."""
