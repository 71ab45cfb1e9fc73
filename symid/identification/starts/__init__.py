"""Where a solve begins: from the recording, at random, by a search, among loops that stay standing."""
