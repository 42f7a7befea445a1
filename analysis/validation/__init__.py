"""Checks of the material rod: references from closed forms and boundary value problems, measured against runs.

``wire`` is the rod of the checks; ``elastica``, ``twisted``, ``bar``, ``beam`` and ``release`` compute what a
correct rod does, ``planar_stability`` where it leaves its plane; ``tested`` has the rows that tests of Core hold;
``report`` puts all into one table. All numbers are in SI units unless a name says otherwise.
"""
