#include "app/evaluation/console/certificate.h"

#include <openssl/bio.h>
#include <openssl/ec.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>

#include <array>
#include <memory>

#include <fmt/core.h>

#include "app/session/session_error.h"

namespace app {
namespace {

template <auto kFree>
struct Freed {
  template <class Type>
  void operator()(Type* one) const {
    kFree(one);
  }
};
using Key = std::unique_ptr<EVP_PKEY, Freed<EVP_PKEY_free>>;
using Certificate = std::unique_ptr<X509, Freed<X509_free>>;
using Memory = std::unique_ptr<BIO, Freed<BIO_free_all>>;

void mustBe(bool is_so) {
  if (!is_so) throw SessionError("--share: OpenSSL makes no certificate here, leave --share out");
}

}  // namespace

std::string selfMadeIdentity() {
  const Key key(EVP_EC_gen("P-256"));
  const Certificate made(X509_new());
  mustBe(key != nullptr && made != nullptr);
  constexpr long kYesterday_s = -86'400, kTwoDays_s = 172'800, kVersion3 = 2;
  std::array<unsigned char, 8> serial{};
  const std::unique_ptr<BIGNUM, Freed<BN_free>> number(BN_new());
  mustBe(number != nullptr &&
         BN_rand(number.get(), 8 * static_cast<int>(serial.size()), BN_RAND_TOP_ONE, BN_RAND_BOTTOM_ANY) == 1);
  mustBe(BN_to_ASN1_INTEGER(number.get(), X509_get_serialNumber(made.get())) != nullptr);
  mustBe(X509_set_version(made.get(), kVersion3) == 1 && X509_set_pubkey(made.get(), key.get()) == 1);
  mustBe(X509_gmtime_adj(X509_getm_notBefore(made.get()), kYesterday_s) != nullptr &&
         X509_gmtime_adj(X509_getm_notAfter(made.get()), kTwoDays_s) != nullptr);
  X509_NAME* const name = X509_get_subject_name(made.get());
  const auto* const station = reinterpret_cast<const unsigned char*>("molar station");
  mustBe(X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_UTF8, station, -1, -1, 0) == 1 &&
         X509_set_issuer_name(made.get(), name) == 1);
  mustBe(X509_sign(made.get(), key.get(), EVP_sha256()) != 0);
  const Memory text(BIO_new(BIO_s_mem()));
  mustBe(text != nullptr &&
         PEM_write_bio_PrivateKey(text.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr) == 1 &&
         PEM_write_bio_X509(text.get(), made.get()) == 1);
  char* bytes = nullptr;
  const long size = BIO_get_mem_data(text.get(), &bytes);
  return {bytes, static_cast<std::size_t>(size)};
}

std::string fingerprintOf(const std::string& identity) {
  const Memory text(BIO_new_mem_buf(identity.data(), static_cast<int>(identity.size())));
  mustBe(text != nullptr);
  const Certificate made(PEM_read_bio_X509(text.get(), nullptr, nullptr, nullptr));
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  mustBe(made != nullptr && X509_digest(made.get(), EVP_sha256(), digest.data(), &size) == 1);
  std::string words;
  for (unsigned n = 0; n < size; ++n) words += fmt::format("{}{:02X}", n > 0 ? ":" : "", digest[n]);
  return words;
}

}  // namespace app
