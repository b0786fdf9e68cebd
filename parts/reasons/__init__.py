"""The English sentences of refusals by code, a table a subject; translated by the catalogues in ``parts/locale``."""
