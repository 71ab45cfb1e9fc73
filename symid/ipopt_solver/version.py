"""Which Ipopt solves."""


def ipopt_version() -> str:
    """The version of the Ipopt that cyipopt is built against, as text; ImportError where cyipopt does not load."""
    import cyipopt

    return ".".join(map(str, cyipopt.IPOPT_VERSION))
