"""Scenes: a description in YAML or Python becomes a keyword deck."""
