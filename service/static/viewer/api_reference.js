// The page /docs: every call of the API, to read and to try. The library is served from here, as all the page's files.

window.SwaggerUIBundle({
  url: '/openapi.json',
  dom_id: '#api',
  deepLinking: true,
  validatorUrl: null, // it would ask another site
  persistAuthorization: false,
});
