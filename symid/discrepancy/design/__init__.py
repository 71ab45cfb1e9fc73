"""Which experiment would tell answers apart that a recording does not."""
