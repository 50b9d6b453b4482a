"""The sentences for what the native module tells by codes: the notes of native/include/reflines/note.h."""
from collections.abc import Iterable

from .. import native
from ..model.border import NAMES

CLAMPED, FLOW, CURVATURE = NAMES["clamped"], NAMES["flow"], NAMES["curvature"]

# By a note's kind; {n} is its count, {change} its numbers before and after, and of [one|many] the count chooses.
SENTENCES = {
    "faces_would_turn": "Nothing was changed: faces would have turned by more than 45 degrees: deselect those that the "
                        "view sees at a slant, or turn the view camera towards them.",
    "light_would_worsen": "Nothing was changed: the lines would have become less even in one light ({change} degrees). "
                          "Select less, or give a Length.",
    "no_strength": "The strength is 0: nothing was changed.",
    "no_flaws": "No noise, ripples or dents were found: nothing was changed. Give a Length to smooth more.",
    "limited": "The limit of the move holds back {n} [vertex|vertices]; what is deeper is left.",
    "longer_waves": "Longer waves were left, for they may be design: with twice the Flaw Size they count as flaws, "
                    "too.",
    "unfinished": "The solver stopped before its end; the lines are more even in every light all the same. Select less "
                  "to let it finish.",
    "held_faces": "{n} [face was|faces were] left alone that would have turned by more than 45 degrees.",
    "border_turned": "The border was turned by up to {after:.2g} degrees to follow its neighbours.",
    "following_worsens": f"The border is only {CLAMPED}: following its neighbours, lines would have become less even.",
    "joining_worsens": f"The border is only {CLAMPED}: smoothed across the gap, lines would have become less even.",
    "continuing_worsens": f"The border is only {CLAMPED}: with its curvature continued, lines would have ended less "
                          "even in one light (they deviate by {after:.3g} instead of {before:.3g} degrees).",
    "continuing_changes_nothing": f"The border is only {CLAMPED}: with its curvature continued, nothing could have "
                                  "been changed.",
    "continuing_fails": f"The border is only {CLAMPED}: with its curvature continued, the solver breaks down.",
    "not_faired": "There are no faces beside the region by which its border could be faired: it was held.",
    "partly_faired": "At {n} [vertex|vertices] of the border there are no faces beside the region by which it could be "
                     "faired: it was held there.",
    "turned_away": "{n} [face|faces] turned away from the view or folded over: left as they are.",
    "sharp_edges": "{n} [edge bends|edges bend] too sharply for a fair panel (gaps, folds, hems); held, the lines are "
                   "solved on each side.",
    "sharp_edges_kept": "{n} [edge bends|edges bend] too sharply for a fair panel (gaps, folds, hems); kept sharp, the "
                        "lines are solved on each side.",
    "marked_edges": "{n} [edge is|edges are] marked as creases; held, the lines are solved on each side.",
    "marked_edges_kept": "{n} [edge is|edges are] marked as creases; kept sharp, the lines are solved on each side.",
    "edge_on": "{n} [face|faces] seen nearly edge on (less than 12 degrees): left as they are.",
    "unused_pieces": "{n} [piece of the region has|pieces of the region have] no free vertex and [stays as it is|stay "
                     "as they are].",
    "hidden_faces": "The lines are not defined on {n} [face that mirrors|faces that mirror] the view almost along the "
                    "light lines; little or no weight there.",
    "unseen": "Light {n} of the set has no weight: from its view the region is turned away or hidden.",
    "features": "{n} [face bends far more than the panel, and runs|faces bend far more than the panel, and run] on "
                "(fillets, hems, gaps); their lines are kept.",
    "curvature_unknown": "No faces beside the region tell the curvature of its border, which is only "
                         f"{CLAMPED}.",
    "curvature_partly_unknown": "At {n} [vertex|vertices] of the border the faces beside it do not tell its curvature, "
                                "since they are too few, bend at a crease or have noise: it is only "
                                f"{CLAMPED} there.",
    "strong_border_bend": "At {n} [vertex|vertices] of the border the surface bends strongly on one of its sides, as "
                          f"at a hem: it is only {CLAMPED} there.",
    "flow_unknown": "At {n} [vertex|vertices] of the border the faces beside it do not tell the rate at which its "
                    f"curvature changes: {FLOW} is the same as {CURVATURE} there.",
}


def word_note(note: "native.Note") -> str:
    """Returns the sentence for a note."""
    text, one = SENTENCES[note.kind], note.count == 1
    while "[" in text:
        begin, end = text.index("["), text.index("]")
        singular, plural = text[begin + 1:end].split("|")
        text = text[:begin] + (singular if one else plural) + text[end + 1:]
    return text.format(n=note.count, before=note.before, after=note.after,
                       change=format_change(note.before, note.after))


def word_notes(notes: "Iterable[native.Note]") -> tuple[str, ...]:
    """Returns the sentences for notes, in their order."""
    return tuple(word_note(note) for note in notes)


def format_change(before: float, after: float) -> str:
    """Formats two numbers with three digits, or with as many as tell one from the other."""
    digits = next((digits for digits in range(3, 17) if f"{before:.{digits}g}" != f"{after:.{digits}g}"), 17)
    return f"{before:.{digits}g} to {after:.{digits}g}"
