"""Words of a run of pytest that a test starts."""

NOT_OURS = ("cacheprovider", "hypothesispytest", "anyio", "beet", "pytest_cov")
PLAIN = tuple(word for name in NOT_OURS for word in ("-p", f"no:{name}"))
"""They leave out plugins that other packages bring, whose imports take over half of a short run."""
