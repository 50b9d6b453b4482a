"""Refusals: requests that cannot be met. Nothing has been changed then, and operators report the sentence."""


class Refusal(Exception):
    """One sentence for the user: what, how many, what to do."""
