"""The English sentences of refusals by code, a file a subject; translated by the catalogues in ``parts/locale``."""
