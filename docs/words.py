"""For the reference pages: what stands behind ``name :`` in a docstring of symid is a description, not a type."""

import griffe


class DescriptionsAfterColon(griffe.Extension):
    """The text after the colon, which may run over several lines, becomes the description.

    Types stand in the signature; the name before the colon of an exception is its type.
    """

    def on_object(self, *, obj: griffe.Object, **_) -> None:
        if obj.docstring is None:
            return
        sections = obj.docstring.parse("numpy", warnings=False)
        for section in sections:
            if section.kind.value in ("parameters", "attributes"):
                for item in section.value:
                    if isinstance(item.annotation, str):
                        item.description = f"{item.annotation} {item.description}".strip()
                        item.annotation = None
            if section.kind.value == "raises":
                for item in section.value:
                    names, _, text = str(item.annotation).partition(" : ")
                    item.annotation, item.description = names, f"{text} {item.description}".strip()
        vars(obj.docstring)["parsed"] = sections  # the cached property that the page is made from
