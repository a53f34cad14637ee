"""What several problems' checks are made of."""
