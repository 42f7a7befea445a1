"""Instruments: what their files state, and their bench tests as scenes and as the results of such runs."""
