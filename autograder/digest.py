"""A name for contents, by which they are known again."""

import hashlib


def digest(*parts: str | bytes) -> str:
    """A name for these parts: different for different parts, wherever one ends and the next begins."""
    whole = hashlib.sha256()
    for part in parts:
        data = part.encode(errors="surrogatepass") if isinstance(part, str) else part
        whole.update(len(data).to_bytes(8, "big") + data)
    return whole.hexdigest()
