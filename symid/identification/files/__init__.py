"""A solution as files: to go on with it, to read it without symid, to use it elsewhere."""
