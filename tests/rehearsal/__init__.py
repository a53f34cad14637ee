"""A term rehearsed with the commands of the guide, and a ledger of its marks that is kept apart."""
