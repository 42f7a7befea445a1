"""Checks of the material rod: references from closed forms and boundary value problems, measured against runs.

``wire`` is the rod that the checks are about; ``elastica``, ``spatial``, ``twisted``, ``bar``, ``beam`` and ``release``
compute what a correct rod does, ``planar_stability`` where it leaves its plane; ``rows`` say what each check measures;
``report`` puts them into one table. All numbers are in SI units unless a name says otherwise.
"""
