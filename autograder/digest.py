"""Names contents by a hash, so that the same contents are recognised."""

import hashlib


def digest(*parts: str | bytes) -> str:
    """A name for these parts; other parts have another name, even if they join to the same text."""
    whole = hashlib.sha256()
    for part in parts:
        data = part.encode(errors="surrogatepass") if isinstance(part, str) else part
        whole.update(len(data).to_bytes(8, "big") + data)
    return whole.hexdigest()
